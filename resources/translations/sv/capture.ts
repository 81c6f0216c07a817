<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>A capture that was not used for {days} days was removed.</source>
            <translation>En avbildning som inte hade använts på {days} dagar togs bort.</translation>
        </message>
        <message>
            <source>A foot that is not seen from all sides is cut, or too short.</source>
            <translation>En fot som inte syns från alla sidor är kapad eller för kort.</translation>
        </message>
        <message>
            <source>All views in order; a sensor is moved to those that have none</source>
            <translation>Alla vyer i ordning; en sensor flyttas till dem som saknar en</translation>
        </message>
        <message>
            <source>Almost nothing is measured; check distance and light</source>
            <translation>Nästan inget mäts; kontrollera avstånd och ljus</translation>
        </message>
        <message>
            <source>Before it: {count} more, offered after it.</source>
            <translation>Före den: {count} till, som erbjuds efter den.</translation>
        </message>
        <message>
            <source>Capture the view (F5)</source>
            <translation>Avbilda vyn (F5)</translation>
        </message>
        <message>
            <source>Capturing view {view}</source>
            <translation>Avbildar vy {view}</translation>
        </message>
        <message>
            <source>Checking view {view}</source>
            <translation>Kontrollerar vy {view}</translation>
        </message>
        <message>
            <source>Delete the views for good</source>
            <translation>Ta bort vyerna för gott</translation>
        </message>
        <message>
            <source>Discard it</source>
            <translation>Kasta den</translation>
        </message>
        <message>
            <source>Go on capturing</source>
            <translation>Fortsätt avbilda</translation>
        </message>
        <message>
            <source>Go on with it</source>
            <translation>Fortsätt med den</translation>
        </message>
        <message>
            <source>High accuracy</source>
            <translation>Hög noggrannhet</translation>
        </message>
        <message>
            <source>High accuracy: few wrong readings, more gaps. High density: the reverse.</source>
            <translation>Hög noggrannhet: få felaktiga mätvärden, fler luckor. Hög täthet: tvärtom.</translation>
        </message>
        <message>
            <source>High density</source>
            <translation>Hög täthet</translation>
        </message>
        <message>
            <source>Infrared pair</source>
            <translation>Infrarött par</translation>
        </message>
        <message>
            <source>Infrared pair of sensor {serial}</source>
            <translation>Infrarött par från sensor {serial}</translation>
        </message>
        <message>
            <source>It is kept until {day}.</source>
            <translation>Den sparas till {day}.</translation>
        </message>
        <message>
            <source>Light of sensor {serial}</source>
            <translation>Ljus från sensor {serial}</translation>
        </message>
        <message>
            <source>Light: </source>
            <translation>Ljus: </translation>
        </message>
        <message>
            <source>Moved by hand</source>
            <translation>Flyttas för hand</translation>
        </message>
        <message>
            <source>No foot between the markers</source>
            <translation>Ingen fot mellan markörerna</translation>
        </message>
        <message>
            <source>No left foot in its place</source>
            <translation>Ingen vänsterfot på sin plats</translation>
        </message>
        <message>
            <source>No right foot in its place</source>
            <translation>Ingen högerfot på sin plats</translation>
        </message>
        <message>
            <source>Power of the projector: less where the depth has holes in what is bright and near</source>
            <translation>Projektorns effekt: mindre där djupet har hål i det som är ljust och nära</translation>
        </message>
        <message>
            <source>Preset of sensor {serial}</source>
            <translation>Förval för sensor {serial}</translation>
        </message>
        <message>
            <source>Put the sensor in its place for view {view}, then say that it stands.</source>
            <translation>Ställ sensorn på sin plats för vy {view}, och säg sedan att den står.</translation>
        </message>
        <message>
            <source>Records its two infrared pictures too, which makes the foot finer. Two such sensors fit on one USB controller instead of three.</source>
            <translation>Spelar även in dess två infraröda bilder, vilket gör foten finare. Två sådana sensorer ryms på en USB-styrenhet i stället för tre.</translation>
        </message>
        <message>
            <source>Something moves; hold the foot still</source>
            <translation>Något rör sig; håll foten stilla</translation>
        </message>
        <message>
            <source>The capture of {time} (both feet) was not used; {there} of {wanted} views are there.</source>
            <translation>Avbildningen från {time} (båda fötterna) har inte använts; {there} av {wanted} vyer finns.</translation>
        </message>
        <message>
            <source>The capture of {time} ({side} foot) was not used; {there} of {wanted} views are there.</source>
            <translation>Avbildningen från {time} ({side} fot) har inte använts; {there} av {wanted} vyer finns.</translation>
        </message>
        <message>
            <source>The earlier scan is kept.</source>
            <translation>Den tidigare skanningen finns kvar.</translation>
        </message>
        <message>
            <source>The left foot is partly hidden by the right one; move the sensor or part the feet</source>
            <translation>Vänsterfoten skyms delvis av högerfoten; flytta sensorn eller sära på fötterna</translation>
        </message>
        <message>
            <source>The markers are not recognised; bring the reference system into the picture</source>
            <translation>Markörerna känns inte igen; för in referenssystemet i bilden</translation>
        </message>
        <message>
            <source>The right foot is partly hidden by the left one; move the sensor or part the feet</source>
            <translation>Högerfoten skyms delvis av vänsterfoten; flytta sensorn eller sära på fötterna</translation>
        </message>
        <message>
            <source>Too bright; turn strong lights away</source>
            <translation>För ljust; vänd bort starka lampor</translation>
        </message>
        <message>
            <source>Too dark; add light</source>
            <translation>För mörkt; tänd mer ljus</translation>
        </message>
        <message>
            <source>Too far: {found:.0f} mm, at most {wanted:.0f} mm is good</source>
            <translation>För långt bort: {found:.0f} mm, högst {wanted:.0f} mm är bra</translation>
        </message>
        <message>
            <source>Too near: {found:.0f} mm, at least {wanted:.0f} mm is good</source>
            <translation>För nära: {found:.0f} mm, minst {wanted:.0f} mm är bra</translation>
        </message>
        <message>
            <source>Use what is there</source>
            <translation>Använd det som finns</translation>
        </message>
        <message>
            <source>Views</source>
            <translation>Vyer</translation>
        </message>
        <message>
            <source>Waiting for steady depth of view {view}</source>
            <translation>Väntar på stadigt djup i vy {view}</translation>
        </message>
        <message>
            <source>far left</source>
            <translation>längst till vänster</translation>
        </message>
        <message>
            <source>far right</source>
            <translation>längst till höger</translation>
        </message>
        <message>
            <source>left, top</source>
            <translation>vänster, uppifrån</translation>
        </message>
        <message>
            <source>middle</source>
            <translation>mitten</translation>
        </message>
        <message>
            <source>right, top</source>
            <translation>höger, uppifrån</translation>
        </message>
        <message>
            <source>{count} captures that were not used for {days} days were removed.</source>
            <translation>{count} avbildningar som inte hade använts på {days} dagar togs bort.</translation>
        </message>
        <message>
            <source>{found:.0f} of {wanted:.0f} markers are hidden</source>
            <translation>{found:.0f} av {wanted:.0f} markörer är skymda</translation>
        </message>
        <message>
            <source>{name}, visit of {time}</source>
            <translation>{name}, besök {time}</translation>
        </message>
        <message>
            <source>{there} of {wanted} views are there.</source>
            <translation>{there} av {wanted} vyer finns.</translation>
        </message>
    </context>
</TS>

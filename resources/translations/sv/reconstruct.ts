<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>A view is refused above</source>
            <translation>En vy avvisas över</translation>
        </message>
        <message>
            <source>Add a marker here</source>
            <translation>Lägg till en markör här</translation>
        </message>
        <message>
            <source>Along the foot</source>
            <translation>Längs foten</translation>
        </message>
        <message>
            <source>As recorded</source>
            <translation>Som inspelat</translation>
        </message>
        <message>
            <source>At foot, mm</source>
            <translation>Vid foten, mm</translation>
        </message>
        <message>
            <source>Blue spot</source>
            <translation>Blå fläck</translation>
        </message>
        <message>
            <source>Change the volume</source>
            <translation>Ändra volymen</translation>
        </message>
        <message>
            <source>Colours</source>
            <translation>Färger</translation>
        </message>
        <message>
            <source>Colours of the foot</source>
            <translation>Fotens färger</translation>
        </message>
        <message>
            <source>Confidence</source>
            <translation>Säkerhet</translation>
        </message>
        <message>
            <source>Coverage</source>
            <translation>Täckning</translation>
        </message>
        <message>
            <source>Depth frames that are used, of those that were recorded</source>
            <translation>Djupbilder som används, av dem som spelades in</translation>
        </message>
        <message>
            <source>Distance between the views</source>
            <translation>Avstånd mellan vyerna</translation>
        </message>
        <message>
            <source>Distance in the colour image from where the pose puts them, root mean square</source>
            <translation>Avstånd i färgbilden från där läget placerar dem, kvadratiskt medelvärde</translation>
        </message>
        <message>
            <source>Distance of the markers in space from the reference system, mean</source>
            <translation>Markörernas avstånd i rummet från referenssystemet, medelvärde</translation>
        </message>
        <message>
            <source>Distance of the markers in space from the reference system, root mean square</source>
            <translation>Markörernas avstånd i rummet från referenssystemet, kvadratiskt medelvärde</translation>
        </message>
        <message>
            <source>Distance of the markers in space from the reference system, the greatest</source>
            <translation>Markörernas avstånd i rummet från referenssystemet, det största</translation>
        </message>
        <message>
            <source>Drag the face of the box along its axis</source>
            <translation>Dra lådans sida längs dess axel</translation>
        </message>
        <message>
            <source>Draw a region that shows no marker</source>
            <translation>Rita ett område som inte visar någon markör</translation>
        </message>
        <message>
            <source>Draw the region that shows the markers</source>
            <translation>Rita området som visar markörerna</translation>
        </message>
        <message>
            <source>Exclude {id}</source>
            <translation>Uteslut {id}</translation>
        </message>
        <message>
            <source>Foot that is shown</source>
            <translation>Fot som visas</translation>
        </message>
        <message>
            <source>Frames</source>
            <translation>Bilder</translation>
        </message>
        <message>
            <source>Go on to design</source>
            <translation>Vidare till utformning</translation>
        </message>
        <message>
            <source>Good</source>
            <translation>Bra</translation>
        </message>
        <message>
            <source>How far the foot may be shifted by what is not known of the sensor's place</source>
            <translation>Hur mycket foten får vara förskjuten av det som inte är känt om sensorns plats</translation>
        </message>
        <message>
            <source>How far the markers may lie in the picture from where they should be seen</source>
            <translation>Hur långt markörerna får ligga i bilden från där de borde synas</translation>
        </message>
        <message>
            <source>How far the markers of a view may lie from where they are known to be</source>
            <translation>Hur långt en vys markörer får ligga från där de är kända att sitta</translation>
        </message>
        <message>
            <source>How uncertain the pose leaves the place of the foot (standard deviation)</source>
            <translation>Hur osäkert läget gör fotens plats (standardavvikelse)</translation>
        </message>
        <message>
            <source>Ignore a blue spot</source>
            <translation>Bortse från en blå fläck</translation>
        </message>
        <message>
            <source>Ignore a region</source>
            <translation>Bortse från ett område</translation>
        </message>
        <message>
            <source>Image, px</source>
            <translation>Bild, px</translation>
        </message>
        <message>
            <source>Include {id}</source>
            <translation>Ta med {id}</translation>
        </message>
        <message>
            <source>Leave out the view {name}</source>
            <translation>Utelämna vyn {name}</translation>
        </message>
        <message>
            <source>Left out by hand</source>
            <translation>Utelämnad för hand</translation>
        </message>
        <message>
            <source>Markers</source>
            <translation>Markörer</translation>
        </message>
        <message>
            <source>Markers in space</source>
            <translation>Markörer i rummet</translation>
        </message>
        <message>
            <source>Markers in the image</source>
            <translation>Markörer i bilden</translation>
        </message>
        <message>
            <source>Markers that determine the pose, of those that were found</source>
            <translation>Markörer som bestämmer läget, av dem som hittades</translation>
        </message>
        <message>
            <source>Max, mm</source>
            <translation>Max, mm</translation>
        </message>
        <message>
            <source>Mean, mm</source>
            <translation>Medel, mm</translation>
        </message>
        <message>
            <source>Moved by the correction</source>
            <translation>Flyttat av korrektionen</translation>
        </message>
        <message>
            <source>No view is placed. Correct its markers, or tick a view.</source>
            <translation>Ingen vy har fått sin plats. Rätta dess markörer, eller bocka för en vy.</translation>
        </message>
        <message>
            <source>Point at {id}</source>
            <translation>Peka ut {id}</translation>
        </message>
        <message>
            <source>RMS, mm</source>
            <translation>RMS, mm</translation>
        </message>
        <message>
            <source>Reconstruct again</source>
            <translation>Rekonstruera igen</translation>
        </message>
        <message>
            <source>Reconstruct and go on</source>
            <translation>Rekonstruera och gå vidare</translation>
        </message>
        <message>
            <source>Reconstruct the foot again</source>
            <translation>Rekonstruera foten igen</translation>
        </message>
        <message>
            <source>Red: how far a marker is off, {number} times enlarged</source>
            <translation>Rött: hur mycket en markör avviker, {number} gånger förstorat</translation>
        </message>
        <message>
            <source>Reset the volume</source>
            <translation>Återställ volymen</translation>
        </message>
        <message>
            <source>Search for {id}</source>
            <translation>Sök efter {id}</translation>
        </message>
        <message>
            <source>Search in a region</source>
            <translation>Sök i ett område</translation>
        </message>
        <message>
            <source>Search only here</source>
            <translation>Sök bara här</translation>
        </message>
        <message>
            <source>Search the whole image</source>
            <translation>Sök i hela bilden</translation>
        </message>
        <message>
            <source>Search the whole image again</source>
            <translation>Sök i hela bilden igen</translation>
        </message>
        <message>
            <source>Skin</source>
            <translation>Hud</translation>
        </message>
        <message>
            <source>Standard deviation</source>
            <translation>Standardavvikelse</translation>
        </message>
        <message>
            <source>Standard deviation, {share:.0%} by infrared</source>
            <translation>Standardavvikelse, {share:.0%} från infrarött</translation>
        </message>
        <message>
            <source>The session is being read.</source>
            <translation>Sessionen läses.</translation>
        </message>
        <message>
            <source>This is</source>
            <translation>Detta är</translation>
        </message>
        <message>
            <source>This is no marker</source>
            <translation>Detta är ingen markör</translation>
        </message>
        <message>
            <source>Tick: the view is used</source>
            <translation>Bock: vyn används</translation>
        </message>
        <message>
            <source>Uncertain at the foot</source>
            <translation>Osäkerhet vid foten</translation>
        </message>
        <message>
            <source>Use the view {name}</source>
            <translation>Använd vyn {name}</translation>
        </message>
        <message>
            <source>View</source>
            <translation>Vy</translation>
        </message>
        <message>
            <source>View {name}: {reason}.</source>
            <translation>Vy {name}: {reason}.</translation>
        </message>
        <message>
            <source>Views that see it</source>
            <translation>Vyer som ser det</translation>
        </message>
        <message>
            <source>Views, each in its colour</source>
            <translation>Vyer, var och en i sin färg</translation>
        </message>
        <message>
            <source>Volume of interest</source>
            <translation>Mätvolym</translation>
        </message>
        <message>
            <source>What lies outside this box is no part of the foot</source>
            <translation>Det som ligger utanför den här lådan hör inte till foten</translation>
        </message>
        <message>
            <source>What the colours of the foot show</source>
            <translation>Vad fotens färger visar</translation>
        </message>
        <message>
            <source>Which of both feet of the session is shown</source>
            <translation>Vilken av sessionens båda fötter som visas</translation>
        </message>
        <message>
            <source>Whole image</source>
            <translation>Hela bilden</translation>
        </message>
        <message>
            <source>Why a view is not used, or what is to be known of it</source>
            <translation>Varför en vy inte används, eller vad man bör veta om den</translation>
        </message>
        <message>
            <source>from</source>
            <translation>från</translation>
        </message>
        <message>
            <source>to</source>
            <translation>till</translation>
        </message>
        <message>
            <source>views</source>
            <translation>vyer</translation>
        </message>
    </context>
</TS>

<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>studio</name>
        <message>
            <source>A skive of {depth} mm with {angle}° of inversion needs a heel cup of {needed} mm, and the cup is {cup} mm deep.</source>
            <translation>En skive på {depth} mm med {angle}° inversion kräver en hälkopp på {needed} mm, och koppen är {cup} mm djup.</translation>
        </message>
        <message>
            <source>Achilles axis {angle}° {kind} to the sole</source>
            <translation>Akillesaxeln {angle}° {kind} mot fotsulan</translation>
        </message>
        <message>
            <source>Add a point here</source>
            <translation>Lägg till en punkt här</translation>
        </message>
        <message>
            <source>Add a point to the outline</source>
            <translation>Lägg till en punkt på konturen</translation>
        </message>
        <message>
            <source>Align</source>
            <translation>Rikta</translation>
        </message>
        <message>
            <source>Align the foot by the landmarks</source>
            <translation>Rikta foten efter landmärkena</translation>
        </message>
        <message>
            <source>An outline needs at least {count} points; this one stays</source>
            <translation>En kontur behöver minst {count} punkter; den här blir kvar</translation>
        </message>
        <message>
            <source>Back to the outline of the foot</source>
            <translation>Tillbaka till fotens kontur</translation>
        </message>
        <message>
            <source>Copy</source>
            <translation>Kopiera</translation>
        </message>
        <message>
            <source>Copy: {name}</source>
            <translation>Kopiera: {name}</translation>
        </message>
        <message>
            <source>Corrections and measures come with the scan.</source>
            <translation>Korrigeringar och mått kommer med avbildningen.</translation>
        </message>
        <message>
            <source>Drag a point of the outline; double click adds one on the line, or takes one away</source>
            <translation>Dra i en punkt på konturen; dubbelklick lägger till en på linjen eller tar bort en</translation>
        </message>
        <message>
            <source>Drag the edge of the insole; from the foot, a shoe's size, or drawn</source>
            <translation>Dra i inläggets kant; från foten, en skostorlek eller ritad</translation>
        </message>
        <message>
            <source>Drag to change the outline of the insole; double click takes the point away</source>
            <translation>Dra för att ändra inläggets kontur; dubbelklick tar bort punkten</translation>
        </message>
        <message>
            <source>Foot against its landmarks</source>
            <translation>Foten mot sina landmärken</translation>
        </message>
        <message>
            <source>Free-hand</source>
            <translation>Frihand</translation>
        </message>
        <message>
            <source>Insole through the foot</source>
            <translation>Inlägget genom foten</translation>
        </message>
        <message>
            <source>Level the sole and lay the foot axis along the insole by the landmarks</source>
            <translation>Lägg sulan plant och fotaxeln längs inlägget efter landmärkena</translation>
        </message>
        <message>
            <source>Medial edge up</source>
            <translation>Medial kant upp</translation>
        </message>
        <message>
            <source>Move a point of the outline</source>
            <translation>Flytta en punkt på konturen</translation>
        </message>
        <message>
            <source>Only {share} of the {pad} lie below the foot; move it inwards.</source>
            <translation>Bara {share} av elementet ({pad}) ligger under foten; flytta det inåt.</translation>
        </message>
        <message>
            <source>Outline</source>
            <translation>Kontur</translation>
        </message>
        <message>
            <source>Pelott here</source>
            <translation>Pelott här</translation>
        </message>
        <message>
            <source>Pen mark at x {x} mm, y {y} mm</source>
            <translation>Pennmärke vid x {x} mm, y {y} mm</translation>
        </message>
        <message>
            <source>Plane</source>
            <translation>Plan</translation>
        </message>
        <message>
            <source>Post the rearfoot as the rule of the clinic suggests for this axis</source>
            <translation>Kila bakfoten så som klinikens regel föreslår för den här axeln</translation>
        </message>
        <message>
            <source>Pronation / supination (&gt; 0 raises the medial edge)</source>
            <translation>Pronation / supination (&gt; 0 höjer medialkanten)</translation>
        </message>
        <message>
            <source>Propose {angle}° medial</source>
            <translation>Föreslå {angle}° medialt</translation>
        </message>
        <message>
            <source>Read all</source>
            <translation>Läs allt</translation>
        </message>
        <message>
            <source>Remove a point of the outline</source>
            <translation>Ta bort en punkt på konturen</translation>
        </message>
        <message>
            <source>Remove this point</source>
            <translation>Ta bort punkten</translation>
        </message>
        <message>
            <source>Show the insole below the foot, seen through</source>
            <translation>Visa inlägget under foten, genomskinligt</translation>
        </message>
        <message>
            <source>Size</source>
            <translation>Storlek</translation>
        </message>
        <message>
            <source>Take the proposed posting</source>
            <translation>Ta den föreslagna kilningen</translation>
        </message>
        <message>
            <source>The forefoot is posted by {angle}°; more than {usual}° is unusual.</source>
            <translation>Framfoten är kilad {angle}°; mer än {usual}° är ovanligt.</translation>
        </message>
        <message>
            <source>The front edge of the {pad} lies {distance} mm before the line of the heads 2 to 4; {least} to {most} mm behind it are usual.</source>
            <translation>Framkanten ({pad}) ligger {distance} mm framför linjen genom metatarsalhuvud 2 till 4; {least} till {most} mm bakom den är vanligt.</translation>
        </message>
        <message>
            <source>The front edge of the {pad} lies {distance} mm behind the line of the heads 2 to 4; {least} to {most} mm behind it are usual.</source>
            <translation>Framkanten ({pad}) ligger {distance} mm bakom linjen genom metatarsalhuvud 2 till 4; {least} till {most} mm bakom den är vanligt.</translation>
        </message>
        <message>
            <source>The heel is lifted by {height} mm; on the device up to {usual} mm are usual.</source>
            <translation>Hälen är höjd {height} mm; på inlägget är upp till {usual} mm vanligt.</translation>
        </message>
        <message>
            <source>The insole is {height} mm high and may not fit a shoe; up to {usual} mm are usual.</source>
            <translation>Inlägget är {height} mm högt och får kanske inte plats i en sko; upp till {usual} mm är vanligt.</translation>
        </message>
        <message>
            <source>The landmarks {landmark} and {other_landmark} stand in an order that no foot has; drag them to where they belong.</source>
            <translation>Landmärkena {landmark} och {other_landmark} står i en ordning som ingen fot har; dra dem dit de hör.</translation>
        </message>
        <message>
            <source>The rearfoot is posted by {angle}°; more than {usual}° is unusual.</source>
            <translation>Bakfoten är kilad {angle}°; mer än {usual}° är ovanligt.</translation>
        </message>
        <message>
            <source>The {pad} lies with {share} on the {other_pad}, and their heights add up.</source>
            <translation>Elementet ({pad}) ligger till {share} på ett annat ({other_pad}), och höjderna läggs ihop.</translation>
        </message>
        <message>
            <source>There the outline would cross itself; the last good place is kept</source>
            <translation>Där skulle konturen korsa sig själv; den sista giltiga platsen behålls</translation>
        </message>
        <message>
            <source>Toe end up</source>
            <translation>Tåändan upp</translation>
        </message>
        <message>
            <source>Toes medially</source>
            <translation>Tår medialt</translation>
        </message>
        <message>
            <source>Turn the foot</source>
            <translation>Vrid foten</translation>
        </message>
        <message>
            <source>Use a pen mark as: {name}</source>
            <translation>Använd ett pennmärke som: {name}</translation>
        </message>
        <message>
            <source>Use as {name}</source>
            <translation>Använd som {name}</translation>
        </message>
        <message>
            <source>valgus</source>
            <translation>valgus</translation>
        </message>
        <message>
            <source>varus</source>
            <translation>varus</translation>
        </message>
        <message>
            <source>{angle}° {kind}</source>
            <translation>{angle}° {kind}</translation>
        </message>
        <message>
            <source>{typed} cannot be taken; put in {least} to {greatest}. It stays {before}.</source>
            <translation>{typed} går inte; ange {least} till {greatest}. Det förblir {before}.</translation>
        </message>
    </context>
</TS>

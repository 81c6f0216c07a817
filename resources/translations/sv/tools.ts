<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>1 warning</source>
            <translation>1 varning</translation>
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
            <source>All landmarks are confirmed where they stand.</source>
            <translation>Alla landmärken är bekräftade där de står.</translation>
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
            <source>Click on foot or insole where the tape begins</source>
            <translation>Klicka på foten eller inlägget där måttbandet börjar</translation>
        </message>
        <message>
            <source>Click where it ends</source>
            <translation>Klicka där det slutar</translation>
        </message>
        <message>
            <source>Copy: {name}</source>
            <translation>Kopiera: {name}</translation>
        </message>
        <message>
            <source>Corrections and measures come with the scan.</source>
            <translation>Korrigeringar och mått kommer med skanningen.</translation>
        </message>
        <message>
            <source>Drag a point of the outline, and its neighbours follow; double click adds one on the line, or takes one away</source>
            <translation>Dra i en punkt på konturen, så följer grannarna med; dubbelklick lägger till en på linjen eller tar bort en</translation>
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
            <source>How far the ball lies higher than the heel</source>
            <translation>Hur mycket högre trampdynan ligger än hälen</translation>
        </message>
        <message>
            <source>How far the foot is rolled onto its lateral edge</source>
            <translation>Hur mycket foten är rullad över på lateralkanten</translation>
        </message>
        <message>
            <source>How far the foot is turned on the ground, the toes to the medial side</source>
            <translation>Hur mycket foten är vriden på marken, tårna åt medialsidan</translation>
        </message>
        <message>
            <source>If the scan lies wrongly</source>
            <translation>Om skanningen ligger fel</translation>
        </message>
        <message>
            <source>Insole through the foot</source>
            <translation>Inlägget genom foten</translation>
        </message>
        <message>
            <source>Lay a foot that lies roughly right on its sole, and its axis along the insole</source>
            <translation>Lägg en fot som ligger ungefär rätt på fotsulan, med axeln längs inlägget</translation>
        </message>
        <message>
            <source>Lay the tape</source>
            <translation>Lägg måttbandet</translation>
        </message>
        <message>
            <source>Level the sole</source>
            <translation>Lägg fotsulan plant</translation>
        </message>
        <message>
            <source>Level the sole and lay the foot axis along the insole by the landmarks</source>
            <translation>Lägg fotsulan plant och fotaxeln längs inlägget efter landmärkena</translation>
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
            <source>Pelott here</source>
            <translation>Pelott här</translation>
        </message>
        <message>
            <source>Pen mark: {place}</source>
            <translation>Pennmärke: {place}</translation>
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
            <source>Remove the tape</source>
            <translation>Ta bort måttbandet</translation>
        </message>
        <message>
            <source>Remove this point</source>
            <translation>Ta bort punkten</translation>
        </message>
        <message>
            <source>Roll 90°</source>
            <translation>Rulla 90°</translation>
        </message>
        <message>
            <source>Roll the foot over its edge</source>
            <translation>Rulla foten över kanten</translation>
        </message>
        <message>
            <source>Show all warnings</source>
            <translation>Visa alla varningar</translation>
        </message>
        <message>
            <source>Show the insole below the foot, seen through</source>
            <translation>Visa inlägget under foten, genomskinligt</translation>
        </message>
        <message>
            <source>Take the proposed posting</source>
            <translation>Ta den föreslagna kilningen</translation>
        </message>
        <message>
            <source>There the outline would cross itself; the last good place is kept</source>
            <translation>Där skulle konturen korsa sig själv; den sista giltiga platsen behålls</translation>
        </message>
        <message>
            <source>Tip the foot over its heel</source>
            <translation>Tippa foten över hälen</translation>
        </message>
        <message>
            <source>Tip the foot over its toes</source>
            <translation>Tippa foten över tårna</translation>
        </message>
        <message>
            <source>Toes down 90°</source>
            <translation>Tårna ned 90°</translation>
        </message>
        <message>
            <source>Toes medially</source>
            <translation>Tår medialt</translation>
        </message>
        <message>
            <source>Toes up 90°</source>
            <translation>Tårna upp 90°</translation>
        </message>
        <message>
            <source>Turn 90°</source>
            <translation>Vrid 90°</translation>
        </message>
        <message>
            <source>Turn the foot by 90°</source>
            <translation>Vrid foten 90°</translation>
        </message>
        <message>
            <source>Turn the foot on the ground, to the left</source>
            <translation>Vrid foten på marken, åt vänster</translation>
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
            <source>click to go on, double click to end, Ctrl+Z to take the last point back</source>
            <translation>klicka för att fortsätta, dubbelklicka för att avsluta, Ctrl+Z tar tillbaka den sista punkten</translation>
        </message>
        <message>
            <source>{along} mm along the surface, {straight} mm straight</source>
            <translation>{along} mm längs ytan, {straight} mm rakt</translation>
        </message>
        <message>
            <source>{angle}° valgus</source>
            <translation>{angle}° valgus</translation>
        </message>
        <message>
            <source>{angle}° varus</source>
            <translation>{angle}° varus</translation>
        </message>
        <message>
            <source>{angle}° {kind}</source>
            <translation>{angle}° {kind}</translation>
        </message>
        <message>
            <source>{count} warnings</source>
            <translation>{count} varningar</translation>
        </message>
        <message>
            <source>{typed} cannot be taken; put in {least} to {greatest}, or 0 if it is not known. It stays {before}.</source>
            <translation>{typed} går inte; ange {least} till {greatest}, eller 0 om värdet är okänt. Det förblir {before}.</translation>
        </message>
        <message>
            <source>{typed} cannot be taken; put in {least} to {greatest}. It stays {before}.</source>
            <translation>{typed} går inte; ange {least} till {greatest}. Det förblir {before}.</translation>
        </message>
        <message>
            <source>{typed} is taken as {rounded}.</source>
            <translation>{typed} avrundas till {rounded}.</translation>
        </message>
    </context>
</TS>

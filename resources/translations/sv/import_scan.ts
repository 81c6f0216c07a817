<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE">
    <context>
        <name>insole_studio</name>
        <message>
            <source>A foam box or another imprint</source>
            <translation>En skumlåda eller annat avtryck</translation>
        </message>
        <message>
            <source>A foot</source>
            <translation>En fot</translation>
        </message>
        <message>
            <source>A left foot by its shape</source>
            <translation>Vänsterfot enligt formen</translation>
        </message>
        <message>
            <source>A plaster cast, taken under weight</source>
            <translation>Gips, taget under belastning</translation>
        </message>
        <message>
            <source>A plaster cast, taken without weight</source>
            <translation>Gips, taget utan belastning</translation>
        </message>
        <message>
            <source>A right foot by its shape</source>
            <translation>Högerfot enligt formen</translation>
        </message>
        <message>
            <source>As the shape tells</source>
            <translation>Som formen visar</translation>
        </message>
        <message>
            <source>Choose the unit of the file, or a length that is known.</source>
            <translation>Välj filens enhet, eller en längd som är känd.</translation>
        </message>
        <message>
            <source>Choose which foot it is.</source>
            <translation>Välj vilken fot det är.</translation>
        </message>
        <message>
            <source>Click heel, toes and sole</source>
            <translation>Klicka på häl, tår och fotsula</translation>
        </message>
        <message>
            <source>Click the end of the heel.</source>
            <translation>Klicka på hälens bakersta punkt.</translation>
        </message>
        <message>
            <source>Click the sole, under the ball of the foot.</source>
            <translation>Klicka på fotsulan, under främre trampdynan.</translation>
        </message>
        <message>
            <source>Click the tip of a toe.</source>
            <translation>Klicka på spetsen av en tå.</translation>
        </message>
        <message>
            <source>Click two points of the scan that are as far apart as this.</source>
            <translation>Klicka på två punkter i skanningen som ligger så långt från varandra.</translation>
        </message>
        <message>
            <source>Distance of the two points</source>
            <translation>Avstånd mellan de två punkterna</translation>
        </message>
        <message>
            <source>Feet of the scan</source>
            <translation>Fötter i skanningen</translation>
        </message>
        <message>
            <source>How it lies</source>
            <translation>Hur den ligger</translation>
        </message>
        <message>
            <source>Left or right foot</source>
            <translation>Vänster- eller högerfot</translation>
        </message>
        <message>
            <source>Length of the foot</source>
            <translation>Fotens längd</translation>
        </message>
        <message>
            <source>Mark the feet that are to be opened.</source>
            <translation>Markera de fötter som ska öppnas.</translation>
        </message>
        <message>
            <source>Open</source>
            <translation>Öppna</translation>
        </message>
        <message>
            <source>Open the scan {name}</source>
            <translation>Öppna skanningen {name}</translation>
        </message>
        <message>
            <source>Sole</source>
            <translation>Fotsula</translation>
        </message>
        <message>
            <source>Take the last click back</source>
            <translation>Ta tillbaka senaste klicket</translation>
        </message>
        <message>
            <source>The foot's length is known</source>
            <translation>Fotens längd är känd</translation>
        </message>
        <message>
            <source>The scan shows</source>
            <translation>Skanningen visar</translation>
        </message>
        <message>
            <source>The shoe size is known</source>
            <translation>Skostorleken är känd</translation>
        </message>
        <message>
            <source>Two marked feet are of the same side; choose the other side for one, or take its mark away.</source>
            <translation>Två markerade fötter är av samma sida; välj den andra sidan för en av dem, eller ta bort markeringen för den.</translation>
        </message>
        <message>
            <source>Two points of known distance</source>
            <translation>Två punkter med känt avstånd</translation>
        </message>
        <message>
            <source>Unit or size</source>
            <translation>Enhet eller storlek</translation>
        </message>
        <message>
            <source>leg cut off at {mm:.0f} mm</source>
            <translation>benet avskuret vid {mm:.0f} mm</translation>
        </message>
    </context>
</TS>

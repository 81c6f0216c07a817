<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>3rd head</source>
            <translation>3:e huvudet</translation>
        </message>
        <message>
            <source>4th head</source>
            <translation>4:e huvudet</translation>
        </message>
        <message>
            <source>A map of the bare foot on a plate, in this posture</source>
            <translation>En tryckbild av den nakna foten på en platta, i denna ställning</translation>
        </message>
        <message>
            <source>Add the relief of the library under this head; it can be undone and changed</source>
            <translation>Lägg bibliotekets avlastning under huvudet; den kan ångras och ändras</translation>
        </message>
        <message>
            <source>Change of pressure</source>
            <translation>Ändring av trycket</translation>
        </message>
        <message>
            <source>Change there</source>
            <translation>Ändring där</translation>
        </message>
        <message>
            <source>Click two points whose distance is known</source>
            <translation>Klicka på två punkter vars avstånd är känt</translation>
        </message>
        <message>
            <source>Colour by where this insole takes load off, and where it puts it, by a model</source>
            <translation>Färglägg efter var inlägget avlastar och var det belastar, enligt en modell</translation>
        </message>
        <message>
            <source>Compared with</source>
            <translation>Jämfört med</translation>
        </message>
        <message>
            <source>Contact {old} → {new} cm²</source>
            <translation>Kontakt {old} → {new} cm²</translation>
        </message>
        <message>
            <source>Counter-clockwise, seen from above</source>
            <translation>Moturs, sett uppifrån</translation>
        </message>
        <message>
            <source>Distance of two clicks</source>
            <translation>Avstånd mellan två klick</translation>
        </message>
        <message>
            <source>Dots</source>
            <translation>Punkter</translation>
        </message>
        <message>
            <source>Dots, or two clicks and their distance</source>
            <translation>Punkter, eller två klick och deras avstånd</translation>
        </message>
        <message>
            <source>Drag around the middle to turn the map</source>
            <translation>Dra runt mitten för att vrida bilden</translation>
        </message>
        <message>
            <source>Drag the map to move it, the handle ahead of it to turn it; arrow keys move too</source>
            <translation>Dra bilden för att flytta den, handtaget framför för att vrida den; piltangenterna flyttar också</translation>
        </message>
        <message>
            <source>Else the colours show the change from that variant to this one</source>
            <translation>Annars visar färgerna ändringen från den varianten till den här</translation>
        </message>
        <message>
            <source>Every head above it is relieved.</source>
            <translation>Varje huvud över gränsen är avlastat.</translation>
        </message>
        <message>
            <source>Fit the tissue to the map under the foot</source>
            <translation>Anpassa vävnaden till tryckbilden under foten</translation>
        </message>
        <message>
            <source>Fitted to the map. Where the fit did not look ({names}), it is off by {error} %.</source>
            <translation>Anpassad till tryckbilden. Där anpassningen inte tittade ({names}) är den {error} % fel.</translation>
        </message>
        <message>
            <source>Footprint</source>
            <translation>Fotavtryck</translation>
        </message>
        <message>
            <source>Frame</source>
            <translation>Bild</translation>
        </message>
        <message>
            <source>Greatest pressure</source>
            <translation>Största tryck</translation>
        </message>
        <message>
            <source>Ground contact</source>
            <translation>Markkontakt</translation>
        </message>
        <message>
            <source>How much the map covers foot and insole</source>
            <translation>Hur mycket bilden täcker fot och inlägg</translation>
        </message>
        <message>
            <source>I have read what this can tell and what it cannot</source>
            <translation>Jag har läst vad den kan säga och inte kan säga</translation>
        </message>
        <message>
            <source>It is no measurement. What the patient's foot does in the shoe, only a measurement in the shoe tells. F1 opens the whole page, with all it was checked against.</source>
            <translation>Den är ingen mätning. Vad patientens fot gör i skon visar bara en mätning i skon. F1 öppnar hela sidan, med allt den har prövats mot.</translation>
        </message>
        <message>
            <source>Lay a map under the foot</source>
            <translation>Lägg en bild under foten</translation>
        </message>
        <message>
            <source>Lay a pressure map or a footprint under this foot first (Tools)</source>
            <translation>Lägg först en tryckbild eller ett fotavtryck under den här foten (Verktyg)</translation>
        </message>
        <message>
            <source>Lay a pressure map or footprint…</source>
            <translation>Lägg en tryckbild eller ett fotavtryck…</translation>
        </message>
        <message>
            <source>Lay under the foot</source>
            <translation>Lägg under foten</translation>
        </message>
        <message>
            <source>Length of the insole</source>
            <translation>Inläggets längd</translation>
        </message>
        <message>
            <source>Map</source>
            <translation>Tryckbild</translation>
        </message>
        <message>
            <source>Move and turn the pressure map or footprint under the foot</source>
            <translation>Flytta och vrid tryckbilden eller fotavtrycket under foten</translation>
        </message>
        <message>
            <source>Move the map</source>
            <translation>Flytta bilden</translation>
        </message>
        <message>
            <source>Moves it across the foot; &gt; 0 is to the right, seen from above</source>
            <translation>Flyttar den tvärs över foten; &gt; 0 är åt höger, sett uppifrån</translation>
        </message>
        <message>
            <source>Moves it along the foot; &gt; 0 is towards the toes</source>
            <translation>Flyttar den längs foten; &gt; 0 är mot tårna</translation>
        </message>
        <message>
            <source>No height can be told: {reason}</source>
            <translation>Ingen höjd kan sägas: {reason}</translation>
        </message>
        <message>
            <source>No height of the pad that was tried reaches it: it makes {low} to {high}.</source>
            <translation>Ingen prövad höjd på pelotten når dit: den ger {low} till {high}.</translation>
        </message>
        <message>
            <source>Not known</source>
            <translation>Okänt</translation>
        </message>
        <message>
            <source>Nothing lies under this foot yet.</source>
            <translation>Ännu ligger inget under den här foten.</translation>
        </message>
        <message>
            <source>Nothing lies under this foot yet; lay a pressure map or a footprint (Tools).</source>
            <translation>Ännu ligger inget under den här foten; lägg en tryckbild eller ett fotavtryck (Verktyg).</translation>
        </message>
        <message>
            <source>One frame</source>
            <translation>En bild</translation>
        </message>
        <message>
            <source>Opacity</source>
            <translation>Täckning</translation>
        </message>
        <message>
            <source>Open a pressure map or a picture of a footprint, and align it to its foot</source>
            <translation>Öppna en tryckbild eller en bild av ett fotavtryck, och passa in den mot foten</translation>
        </message>
        <message>
            <source>Paint the pressure map or footprint over foot and insole</source>
            <translation>Måla tryckbilden eller fotavtrycket över fot och inlägg</translation>
        </message>
        <message>
            <source>Peak pressure</source>
            <translation>Högsta tryck</translation>
        </message>
        <message>
            <source>Peak pressure under a head from which on a relief is proposed</source>
            <translation>Högsta tryck under ett huvud från vilket en avlastning föreslås</translation>
        </message>
        <message>
            <source>Peaks, kPa</source>
            <translation>Högsta tryck, kPa</translation>
        </message>
        <message>
            <source>Posture</source>
            <translation>Ställning</translation>
        </message>
        <message>
            <source>Pressure</source>
            <translation>Tryck</translation>
        </message>
        <message>
            <source>Pressure and footprint</source>
            <translation>Tryck och fotavtryck</translation>
        </message>
        <message>
            <source>Pressure map</source>
            <translation>Tryckbild</translation>
        </message>
        <message>
            <source>Pressure map or footprint</source>
            <translation>Tryckbild eller fotavtryck</translation>
        </message>
        <message>
            <source>Put in the body weight; nothing is assumed.</source>
            <translation>Ange kroppsvikten; inget antas.</translation>
        </message>
        <message>
            <source>Put it on the papers of the order and the prescription</source>
            <translation>Ta med den på orderns papper och ordinationen</translation>
        </message>
        <message>
            <source>Relief: {head} ({kpa:.0f} kPa)</source>
            <translation>Avlasta: {head} ({kpa:.0f} kPa)</translation>
        </message>
        <message>
            <source>Relieve from</source>
            <translation>Avlasta från</translation>
        </message>
        <message>
            <source>Relieve where the pressure is high</source>
            <translation>Avlasta där trycket är högt</translation>
        </message>
        <message>
            <source>Remove the map</source>
            <translation>Ta bort bilden</translation>
        </message>
        <message>
            <source>Seen from</source>
            <translation>Sedd</translation>
        </message>
        <message>
            <source>Sensors apart</source>
            <translation>Sensorernas avstånd</translation>
        </message>
        <message>
            <source>Sensors apart, across</source>
            <translation>Sensorernas avstånd, tvärs</translation>
        </message>
        <message>
            <source>Sensors apart, along</source>
            <translation>Sensorernas avstånd, längs</translation>
        </message>
        <message>
            <source>Show both side by side, each against a flat shoe</source>
            <translation>Visa båda sida vid sida, var och en mot en plan sko</translation>
        </message>
        <message>
            <source>Show the change</source>
            <translation>Visa ändringen</translation>
        </message>
        <message>
            <source>Shown</source>
            <translation>Visas</translation>
        </message>
        <message>
            <source>Still to be said: {list}</source>
            <translation>Ännu att ange: {list}</translation>
        </message>
        <message>
            <source>Target in</source>
            <translation>Mål i</translation>
        </message>
        <message>
            <source>The design has no pad whose height could be varied.</source>
            <translation>Designen har ingen pelott vars höjd kunde varieras.</translation>
        </message>
        <message>
            <source>The height of this pad hardly matters there: it makes {low} to {high}.</source>
            <translation>Pelottens höjd betyder knappt något där: den ger {low} till {high}.</translation>
        </message>
        <message>
            <source>Turn the map</source>
            <translation>Vrid bilden</translation>
        </message>
        <message>
            <source>Turned</source>
            <translation>Vriden</translation>
        </message>
        <message>
            <source>Unit</source>
            <translation>Enhet</translation>
        </message>
        <message>
            <source>What it can tell: where an insole takes load off and where it puts it, in per cent, and which of two designs relieves a place more. Each figure has limits, between which the change should lie in 95 of 100 feet.</source>
            <translation>Vad den kan säga: var ett inlägg avlastar och var det belastar, i procent, och vilken av två designer som avlastar ett ställe mest. Varje tal har gränser, som ändringen bör ligga mellan hos 95 fötter av 100.</translation>
        </message>
        <message>
            <source>What it cannot tell: pressures in kPa, pain, or whether an ulcer heals. The foot is one rigid bone with soft tissue: its arch does not sag and its toes do not bend, so that postings and total contact under the forefoot are judged wrongly. Where the model is not sure enough, it says so. A sole that weight has made flat is refused; less weight on the foot is only known of captures, and reliefs are then understated. Layers without a material are taken for that of the shell.</source>
            <translation>Vad den inte kan säga: tryck i kPa, smärta, eller om ett sår läker. Foten är ett enda stelt ben med mjukdelar: valvet sjunker inte ihop och tårna böjs inte, så kilningar och full kontakt under framfoten bedöms fel. Där modellen inte är säker nog säger den det. En sula som belastning har gjort platt avvisas; mindre belastning på foten är bara känd för inspelningar, och avlastningar underskattas då. Lager utan material räknas som skalets.</translation>
        </message>
        <message>
            <source>a flat shoe</source>
            <translation>en plan sko</translation>
        </message>
        <message>
            <source>above, as one sees one's own foot</source>
            <translation>uppifrån, som man ser sin egen fot</translation>
        </message>
        <message>
            <source>below, as a scanner sees it</source>
            <translation>nerifrån, som en skanner ser den</translation>
        </message>
        <message>
            <source>cannot tell</source>
            <translation>kan inte säga</translation>
        </message>
        <message>
            <source>heel strike</source>
            <translation>hälisättning</translation>
        </message>
        <message>
            <source>heel {heel}, midfoot {midfoot}, heads 1–5: {heads}, hallux {hallux}, toes {toes}</source>
            <translation>häl {heel}, mellanfot {midfoot}, huvud 1–5: {heads}, stortå {hallux}, tår {toes}</translation>
        </message>
        <message>
            <source>newly pressed</source>
            <translation>nytt tryck</translation>
        </message>
        <message>
            <source>no target</source>
            <translation>inget mål</translation>
        </message>
        <message>
            <source>nothing presses</source>
            <translation>inget trycker</translation>
        </message>
        <message>
            <source>nothing told</source>
            <translation>inget sägs</translation>
        </message>
        <message>
            <source>per inch</source>
            <translation>per tum</translation>
        </message>
        <message>
            <source>standing on both feet</source>
            <translation>stående på båda fötterna</translation>
        </message>
        <message>
            <source>table</source>
            <translation>tabell</translation>
        </message>
        <message>
            <source>{name} ({device})</source>
            <translation>{name} ({device})</translation>
        </message>
        <message>
            <source>{number}: frames {first} to {last}</source>
            <translation>{number}: bild {first} till {last}</translation>
        </message>
        <message>
            <source>{pad}: by the model {dose} mm reach {percent}, between {low} and {high} (95 %).</source>
            <translation>{pad}: enligt modellen når {dose} mm {percent}, mellan {low} och {high} (95 %).</translation>
        </message>
        <message>
            <source>{pad}: by the model {dose} mm reach {percent}, but it cannot tell: {reason}</source>
            <translation>{pad}: enligt modellen når {dose} mm {percent}, men den kan inte säga säkert: {reason}</translation>
        </message>
    </context>
</TS>

<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>A drawing with sections and all values, without the name</source>
            <translation>En ritning med snitt och alla värden, utan namnet</translation>
        </message>
        <message>
            <source>A printer's program gets a 3MF</source>
            <translation>Skrivarens program får en 3MF</translation>
        </message>
        <message>
            <source>A smaller file: larger triangles where the surface is flat</source>
            <translation>En mindre fil: större trianglar där ytan är plan</translation>
        </message>
        <message>
            <source>Above</source>
            <translation>Över</translation>
        </message>
        <message>
            <source>Add a block</source>
            <translation>Lägg till ett block</translation>
        </message>
        <message>
            <source>Add a router from its file…</source>
            <translation>Lägg till en fräsmaskin från dess fil…</translation>
        </message>
        <message>
            <source>Add the clinic's own router from its file, save or remove one</source>
            <translation>Lägg till klinikens egen fräsmaskin från dess fil, spara eller ta bort en</translation>
        </message>
        <message>
            <source>All that is prescribed, with the patient's name, for the clinic itself</source>
            <translation>Allt som ordineras, med patientens namn, för kliniken själv</translation>
        </message>
        <message>
            <source>An order holds all files for the shop, and a list by which they can be verified</source>
            <translation>En beställning innehåller alla filer till verkstaden och en lista som de kan kontrolleras mot</translation>
        </message>
        <message>
            <source>And {count} more.</source>
            <translation>Och {count} till.</translation>
        </message>
        <message>
            <source>Any machine</source>
            <translation>Valfri maskin</translation>
        </message>
        <message>
            <source>As it is designed; the piece is being made.</source>
            <translation>Som det är utformat; arbetsstycket görs just nu.</translation>
        </message>
        <message>
            <source>At most {left:.2f} mm of material stay in hollows</source>
            <translation>Högst {left:.2f} mm material blir kvar i fördjupningar</translation>
        </message>
        <message>
            <source>Blocks that your workshop has in stock, beside those that come with the product.</source>
            <translation>Block som er verkstad har i lager, utöver dem som följer med programmet.</translation>
        </message>
        <message>
            <source>Both feet</source>
            <translation>Båda fötterna</translation>
        </message>
        <message>
            <source>Both need {length:.0f} × {width:.0f} × {height:.1f} mm of the block</source>
            <translation>Båda behöver {length:.0f} × {width:.0f} × {height:.1f} mm av blocket</translation>
        </message>
        <message>
            <source>Both stand on the papers; here also on the piece itself</source>
            <translation>Båda står på papperen; här även på själva stycket</translation>
        </message>
        <message>
            <source>By material and body weight</source>
            <translation>Efter material och kroppsvikt</translation>
        </message>
        <message>
            <source>By which day the shop is to deliver</source>
            <translation>Till vilken dag verkstaden ska leverera</translation>
        </message>
        <message>
            <source>Check &amp; export…</source>
            <translation>Kontroll &amp; export…</translation>
        </message>
        <message>
            <source>Check the insole and write it for the shop, with its papers</source>
            <translation>Kontrollera inlägget och skriv det för verkstaden, med papper</translation>
        </message>
        <message>
            <source>Checks</source>
            <translation>Kontroller</translation>
        </message>
        <message>
            <source>Choose a file of zones…</source>
            <translation>Välj en fil med zoner…</translation>
        </message>
        <message>
            <source>Choose the folder to put the folder of order {number} into</source>
            <translation>Välj mappen som mappen för beställning {number} ska läggas i</translation>
        </message>
        <message>
            <source>Clinic, if any</source>
            <translation>Mottagning, om någon</translation>
        </message>
        <message>
            <source>Close enough points</source>
            <translation>Tillräckligt täta punkter</translation>
        </message>
        <message>
            <source>Closed solid</source>
            <translation>Sluten kropp</translation>
        </message>
        <message>
            <source>Colour of the material</source>
            <translation>Materialets färg</translation>
        </message>
        <message>
            <source>Contact surface in a block</source>
            <translation>Kontaktytan i ett block</translation>
        </message>
        <message>
            <source>Cutter ⌀</source>
            <translation>Fräs ⌀</translation>
        </message>
        <message>
            <source>Delete this block</source>
            <translation>Ta bort blocket</translation>
        </message>
        <message>
            <source>Density there</source>
            <translation>Täthet där</translation>
        </message>
        <message>
            <source>Diameter of the cutter, which does not reach into narrower hollows</source>
            <translation>Fräsens diameter; den når inte in i trängre fördjupningar</translation>
        </message>
        <message>
            <source>Do not export</source>
            <translation>Exportera inte</translation>
        </message>
        <message>
            <source>Draft</source>
            <translation>Släppning</translation>
        </message>
        <message>
            <source>Draft and chamfer as the shell of the prescription has them</source>
            <translation>Släppning och fas enligt ordinationens skal</translation>
        </message>
        <message>
            <source>Each layer of the insole as an object of its own</source>
            <translation>Varje skikt av inlägget som ett eget objekt</translation>
        </message>
        <message>
            <source>Engraved</source>
            <translation>Graverat</translation>
        </message>
        <message>
            <source>Export all the same, because</source>
            <translation>Exportera ändå, därför att</translation>
        </message>
        <message>
            <source>Export…</source>
            <translation>Exportera…</translation>
        </message>
        <message>
            <source>Fewer triangles</source>
            <translation>Färre trianglar</translation>
        </message>
        <message>
            <source>Fits the block</source>
            <translation>Ryms i blocket</translation>
        </message>
        <message>
            <source>Foot as a mould</source>
            <translation>Foten som form</translation>
        </message>
        <message>
            <source>Format</source>
            <translation>Format</translation>
        </message>
        <message>
            <source>From a file</source>
            <translation>Från en fil</translation>
        </message>
        <message>
            <source>From the map of pressures</source>
            <translation>Efter tryckkartan</translation>
        </message>
        <message>
            <source>Graded borders</source>
            <translation>Stegvisa gränser</translation>
        </message>
        <message>
            <source>Height in the shoe</source>
            <translation>Höjd i skon</translation>
        </message>
        <message>
            <source>Height of step</source>
            <translation>Steghöjd</translation>
        </message>
        <message>
            <source>Here comes the piece, once it is made.</source>
            <translation>Här visas arbetsstycket när det är gjort.</translation>
        </message>
        <message>
            <source>Hollows for the cutter</source>
            <translation>Hålkälar för fräsen</translation>
        </message>
        <message>
            <source>How dense the print is, with {count} walls</source>
            <translation>Hur tät utskriften är, med {count} väggar</translation>
        </message>
        <message>
            <source>How far apart the points may lie at which the surface is computed</source>
            <translation>Hur långt isär punkterna som ytan beräknas i får ligga</translation>
        </message>
        <message>
            <source>How far the surface may move where triangles are left out</source>
            <translation>Hur långt ytan får flyttas där trianglar utelämnas</translation>
        </message>
        <message>
            <source>How high the insole may be in the shoe</source>
            <translation>Hur högt inlägget får vara i skon</translation>
        </message>
        <message>
            <source>How many are ordered</source>
            <translation>Hur många som beställs</translation>
        </message>
        <message>
            <source>How many triangles the file has at most</source>
            <translation>Hur många trianglar filen har som mest</translation>
        </message>
        <message>
            <source>How much material may be left in hollows too narrow for the cutter</source>
            <translation>Hur mycket material som får bli kvar i fördjupningar som är för trånga för fräsen</translation>
        </message>
        <message>
            <source>How much of the print is filled at these places</source>
            <translation>Hur stor del av utskriften som är fylld på dessa ställen</translation>
        </message>
        <message>
            <source>How much of the surface may lie where no tool comes from above</source>
            <translation>Hur stor del av ytan som får ligga där inget verktyg når uppifrån</translation>
        </message>
        <message>
            <source>How steep the surface may rise over 1 mm</source>
            <translation>Hur brant ytan får stiga på 1 mm</translation>
        </message>
        <message>
            <source>How thick the insole must be at least</source>
            <translation>Hur tjockt inlägget minst måste vara</translation>
        </message>
        <message>
            <source>In the block</source>
            <translation>I blocket</translation>
        </message>
        <message>
            <source>Insole, cover, block and shoe from above, in millimetres</source>
            <translation>Inlägg, överdrag, block och sko uppifrån, i millimeter</translation>
        </message>
        <message>
            <source>Insole, trimmed</source>
            <translation>Inlägg, beskuret</translation>
        </message>
        <message>
            <source>It names the patient and never goes into an order; write it with single files</source>
            <translation>Den nämner patienten och läggs aldrig i en beställning; skriv den med enskilda filer</translation>
        </message>
        <message>
            <source>It stays {before}.</source>
            <translation>Det förblir {before}.</translation>
        </message>
        <message>
            <source>Job sheet for the shop (PDF)</source>
            <translation>Arbetsblad för verkstaden (PDF)</translation>
        </message>
        <message>
            <source>Keep them</source>
            <translation>Behåll dem</translation>
        </message>
        <message>
            <source>Layers as objects</source>
            <translation>Skikten som objekt</translation>
        </message>
        <message>
            <source>Left</source>
            <translation>Vänster</translation>
        </message>
        <message>
            <source>Left over</source>
            <translation>Blir kvar</translation>
        </message>
        <message>
            <source>Left: {text}</source>
            <translation>Vänster: {text}</translation>
        </message>
        <message>
            <source>Look there</source>
            <translation>Titta där</translation>
        </message>
        <message>
            <source>Made on</source>
            <translation>Görs med</translation>
        </message>
        <message>
            <source>Maker of the insole</source>
            <translation>Inläggets tillverkare</translation>
        </message>
        <message>
            <source>Material, left</source>
            <translation>Material, vänster</translation>
        </message>
        <message>
            <source>Material, right</source>
            <translation>Material, höger</translation>
        </message>
        <message>
            <source>May differ by</source>
            <translation>Får avvika</translation>
        </message>
        <message>
            <source>Mill both sides</source>
            <translation>Fräs båda sidorna</translation>
        </message>
        <message>
            <source>Name of the patient</source>
            <translation>Patientens namn</translation>
        </message>
        <message>
            <source>New: {number}</source>
            <translation>Ny: {number}</translation>
        </message>
        <message>
            <source>No blocks of your own yet.</source>
            <translation>Inga egna block ännu.</translation>
        </message>
        <message>
            <source>None</source>
            <translation>Inget</translation>
        </message>
        <message>
            <source>Note the order number</source>
            <translation>Anteckna ordernumret</translation>
        </message>
        <message>
            <source>Nothing</source>
            <translation>Ingenting</translation>
        </message>
        <message>
            <source>Number of the lot that the material comes from</source>
            <translation>Numret på partiet som materialet kommer ur</translation>
        </message>
        <message>
            <source>Of what the insole is made</source>
            <translation>Vad inlägget görs av</translation>
        </message>
        <message>
            <source>On the bottom</source>
            <translation>På undersidan</translation>
        </message>
        <message>
            <source>One order, as a folder</source>
            <translation>En beställning, som mapp</translation>
        </message>
        <message>
            <source>One order, as a zip archive</source>
            <translation>En beställning, som zip-arkiv</translation>
        </message>
        <message>
            <source>Order</source>
            <translation>Beställning</translation>
        </message>
        <message>
            <source>Order {number} is complete.</source>
            <translation>Beställning {number} är fullständig.</translation>
        </message>
        <message>
            <source>Order {number} is not as it was written; do not make it:</source>
            <translation>Beställning {number} är inte som den skrevs; tillverka den inte:</translation>
        </message>
        <message>
            <source>Outcome of the checks (JSON)</source>
            <translation>Kontrollernas utfall (JSON)</translation>
        </message>
        <message>
            <source>Outlines for a cutting machine (DXF)</source>
            <translation>Konturer för en skärmaskin (DXF)</translation>
        </message>
        <message>
            <source>Own block {number}</source>
            <translation>Eget block {number}</translation>
        </message>
        <message>
            <source>Own blocks</source>
            <translation>Egna block</translation>
        </message>
        <message>
            <source>Own blocks…</source>
            <translation>Egna block…</translation>
        </message>
        <message>
            <source>Pairs</source>
            <translation>Par</translation>
        </message>
        <message>
            <source>Paper: {paper}</source>
            <translation>Papper: {paper}</translation>
        </message>
        <message>
            <source>Papers</source>
            <translation>Papper</translation>
        </message>
        <message>
            <source>Patient without a name</source>
            <translation>Patient utan namn</translation>
        </message>
        <message>
            <source>Pieces</source>
            <translation>Stycken</translation>
        </message>
        <message>
            <source>Prescriber and maker…</source>
            <translation>Ordinatör och tillverkare…</translation>
        </message>
        <message>
            <source>Prescription for the record (PDF)</source>
            <translation>Ordination för journalen (PDF)</translation>
        </message>
        <message>
            <source>Pressure from which on a place gets a density of its own</source>
            <translation>Tryck från vilket ett ställe får en egen täthet</translation>
        </message>
        <message>
            <source>Print preset</source>
            <translation>Utskrift</translation>
        </message>
        <message>
            <source>Printer: {name}</source>
            <translation>Skrivare: {name}</translation>
        </message>
        <message>
            <source>Pseudonym, side and date</source>
            <translation>Pseudonym, sida och datum</translation>
        </message>
        <message>
            <source>Raised</source>
            <translation>Upphöjt</translation>
        </message>
        <message>
            <source>Reason, for the record</source>
            <translation>Skäl, för journalen</translation>
        </message>
        <message>
            <source>Remove {name}</source>
            <translation>Ta bort {name}</translation>
        </message>
        <message>
            <source>Replace them</source>
            <translation>Ersätt dem</translation>
        </message>
        <message>
            <source>Right</source>
            <translation>Höger</translation>
        </message>
        <message>
            <source>Right: {text}</source>
            <translation>Höger: {text}</translation>
        </message>
        <message>
            <source>Router (*.json)</source>
            <translation>Fräsmaskin (*.json)</translation>
        </message>
        <message>
            <source>Router: {name}</source>
            <translation>Fräsmaskin: {name}</translation>
        </message>
        <message>
            <source>Routers…</source>
            <translation>Fräsmaskiner…</translation>
        </message>
        <message>
            <source>STL is read everywhere; unit, names and layers are in {formats}</source>
            <translation>STL läses överallt; enhet, namn och skikt finns i {formats}</translation>
        </message>
        <message>
            <source>Save the blocks</source>
            <translation>Spara blocken</translation>
        </message>
        <message>
            <source>Save the file of {name}…</source>
            <translation>Spara filen för {name}…</translation>
        </message>
        <message>
            <source>Say whether the files of an order are as they were written</source>
            <translation>Säg om filerna i en beställning är som de skrevs</translation>
        </message>
        <message>
            <source>Seen from above: the foot stands on this side, toes up.</source>
            <translation>Sedd uppifrån: foten står på denna sida, tårna uppåt.</translation>
        </message>
        <message>
            <source>Single files</source>
            <translation>Enskilda filer</translation>
        </message>
        <message>
            <source>Size of the file</source>
            <translation>Filens storlek</translation>
        </message>
        <message>
            <source>Slope of the side walls; &gt; 0 is wider at the bottom</source>
            <translation>Sidoväggarnas lutning; &gt; 0 är bredare nedtill</translation>
        </message>
        <message>
            <source>Something unexpected happened; nothing was written. Please report it.</source>
            <translation>Något oväntat hände; inget skrevs. Anmäl det gärna.</translation>
        </message>
        <message>
            <source>Stopped. Change the order to make it again.</source>
            <translation>Stoppat. Ändra beställningen för att göra om det.</translation>
        </message>
        <message>
            <source>Text</source>
            <translation>Text</translation>
        </message>
        <message>
            <source>That of the chosen router</source>
            <translation>Den valda fräsmaskinens</translation>
        </message>
        <message>
            <source>That of the prescription; {usual:g} kg where it states none</source>
            <translation>Ordinationens; {usual:g} kg där ingen anges</translation>
        </message>
        <message>
            <source>The block is turned over onto dowels, and the underside is milled too</source>
            <translation>Blocket vänds på styrpinnar, och undersidan fräses också</translation>
        </message>
        <message>
            <source>The density changes in three steps of 4 mm where two zones meet, not at once</source>
            <translation>Tätheten ändras i tre steg om 4 mm där två zoner möts, inte på en gång</translation>
        </message>
        <message>
            <source>The insoles of both feet in one order</source>
            <translation>Inläggen för båda fötterna i en beställning</translation>
        </message>
        <message>
            <source>The left foot alone is made; “Both feet” makes the right one too.</source>
            <translation>Bara vänster fot tillverkas; ”Båda fötterna” tillverkar även den högra.</translation>
        </message>
        <message>
            <source>The order of the case before has been written.</source>
            <translation>Beställningen för det förra fallet är skriven.</translation>
        </message>
        <message>
            <source>The order of the case before is still being written.</source>
            <translation>Beställningen för det förra fallet skrivs fortfarande.</translation>
        </message>
        <message>
            <source>The piece of material that it is cut from, which must be large enough</source>
            <translation>Materialstycket som det fräses ur, som måste vara stort nog</translation>
        </message>
        <message>
            <source>The prescription states who prescribes the insole and who makes it, as Annex XIII of the EU regulation on medical devices asks for. The shop does not get it.</source>
            <translation>Ordinationen anger vem som ordinerar inlägget och vem som tillverkar det, som bilaga XIII till EU:s förordning om medicintekniska produkter kräver. Verkstaden får den inte.</translation>
        </message>
        <message>
            <source>The printer's program or the router that gets the files</source>
            <translation>Skrivarens program eller fräsmaskinen som får filerna</translation>
        </message>
        <message>
            <source>The right foot alone is made; “Both feet” makes the left one too.</source>
            <translation>Bara höger fot tillverkas; ”Båda fötterna” tillverkar även den vänstra.</translation>
        </message>
        <message>
            <source>The shop makes the newest revision of an order; a new order is made beside it</source>
            <translation>Verkstaden tillverkar den nyaste revisionen av en beställning; en ny beställning tillverkas vid sidan av</translation>
        </message>
        <message>
            <source>The text on the underside</source>
            <translation>Texten på undersidan</translation>
        </message>
        <message>
            <source>These files are there already: {names}</source>
            <translation>Dessa filer finns redan: {names}</translation>
        </message>
        <message>
            <source>They deviate by {deviation:.3f} mm at most.</source>
            <translation>De avviker högst {deviation:.3f} mm.</translation>
        </message>
        <message>
            <source>This prescription was changed elsewhere, and a newer version is stored; what is shown here is not exported.</source>
            <translation>Ordinationen ändrades på annat håll, och en nyare version är sparad; det som visas här exporteras inte.</translation>
        </message>
        <message>
            <source>Undercut</source>
            <translation>Underskärning</translation>
        </message>
        <message>
            <source>Use these</source>
            <translation>Använd dessa</translation>
        </message>
        <message>
            <source>Verify order…</source>
            <translation>Kontrollera beställning…</translation>
        </message>
        <message>
            <source>Walls</source>
            <translation>Väggar</translation>
        </message>
        <message>
            <source>What decides where the print is softer or firmer</source>
            <translation>Vad som avgör var utskriften är mjukare eller fastare</translation>
        </message>
        <message>
            <source>What else the shop is to know, without the patient's name</source>
            <translation>Vad verkstaden mer ska veta, utan patientens namn</translation>
        </message>
        <message>
            <source>What is glued on top</source>
            <translation>Vad som limmas ovanpå</translation>
        </message>
        <message>
            <source>What is made: the insole, its surface in a block, or the foot</source>
            <translation>Vad som görs: inlägget, dess yta i ett block, eller foten</translation>
        </message>
        <message>
            <source>What the shop knows the patient by; without one, the order number {number}</source>
            <translation>Det som verkstaden känner patienten under; utan en sådan ordernumret {number}</translation>
        </message>
        <message>
            <source>What was checked and with which outcome, for other programs</source>
            <translation>Vad som kontrollerades och med vilket utfall, för andra program</translation>
        </message>
        <message>
            <source>Whether a failed check stops the export, warns, or is left out</source>
            <translation>Om en underkänd kontroll stoppar exporten, varnar eller utelämnas</translation>
        </message>
        <message>
            <source>Whether a text is cut into the underside, or stands out of it</source>
            <translation>Om en text fräses in i undersidan eller står ut ur den</translation>
        </message>
        <message>
            <source>Who stands on the prescription</source>
            <translation>Vilka som står på ordinationen</translation>
        </message>
        <message>
            <source>Why it is made although a check has failed; the papers say it</source>
            <translation>Varför det görs fast en kontroll är underkänd; papperen säger det</translation>
        </message>
        <message>
            <source>With serial number and lot</source>
            <translation>Med serienummer och parti</translation>
        </message>
        <message>
            <source>Writing the order of the case before was stopped.</source>
            <translation>Skrivningen av det förra fallets beställning avbröts.</translation>
        </message>
        <message>
            <source>Written as</source>
            <translation>Skrivs som</translation>
        </message>
        <message>
            <source>Written: {name}, to be printed on {paper} paper</source>
            <translation>Skriven: {name}, att skriva ut på {paper}-papper</translation>
        </message>
        <message>
            <source>Zones</source>
            <translation>Zoner</translation>
        </message>
        <message>
            <source>Zones (*.json)</source>
            <translation>Zoner (*.json)</translation>
        </message>
        <message>
            <source>blocks</source>
            <translation>stoppar</translation>
        </message>
        <message>
            <source>born {date}</source>
            <translation>född {date}</translation>
        </message>
        <message>
            <source>chamfer {mm:g} mm</source>
            <translation>fas {mm:g} mm</translation>
        </message>
        <message>
            <source>closed</source>
            <translation>sluten</translation>
        </message>
        <message>
            <source>does not apply to this piece</source>
            <translation>gäller inte detta arbetsstycke</translation>
        </message>
        <message>
            <source>draft {degrees:g}°</source>
            <translation>släppning {degrees:g}°</translation>
        </message>
        <message>
            <source>draft {medial:g}° medial, {lateral:g}° lateral</source>
            <translation>släppning {medial:g}° medialt, {lateral:g}° lateralt</translation>
        </message>
        <message>
            <source>elsewhere {density:g} %</source>
            <translation>för övrigt {density:g} %</translation>
        </message>
        <message>
            <source>is being checked</source>
            <translation>kontrolleras</translation>
        </message>
        <message>
            <source>no block is chosen</source>
            <translation>inget block är valt</translation>
        </message>
        <message>
            <source>not checked</source>
            <translation>inte kontrollerat</translation>
        </message>
        <message>
            <source>off</source>
            <translation>av</translation>
        </message>
        <message>
            <source>open or inside out</source>
            <translation>öppen eller ut och in</translation>
        </message>
        <message>
            <source>unknown</source>
            <translation>okänd</translation>
        </message>
        <message>
            <source>visit {date}</source>
            <translation>besök {date}</translation>
        </message>
        <message>
            <source>warns</source>
            <translation>varnar</translation>
        </message>
        <message>
            <source>{format} as text</source>
            <translation>{format} som text</translation>
        </message>
        <message>
            <source>{length:.0f} × {width:.0f} × {height:.1f} mm, {volume:.0f} cm³, {count} triangles</source>
            <translation>{length:.0f} × {width:.0f} × {height:.1f} mm, {volume:.0f} cm³, {count} trianglar</translation>
        </message>
        <message>
            <source>{time} without changes of cutters, {length:.0f} m of path</source>
            <translation>{time} utan verktygsbyten, {length:.0f} m bana</translation>
        </message>
        <message>
            <source>{value:.0f} mm² cannot be reached by the cutter</source>
            <translation>{value:.0f} mm² nås inte av fräsen</translation>
        </message>
        <message>
            <source>{value:.1f} mm at the highest place</source>
            <translation>{value:.1f} mm på högsta stället</translation>
        </message>
        <message>
            <source>{value:.1f} mm at the thinnest place</source>
            <translation>{value:.1f} mm på tunnaste stället</translation>
        </message>
        <message>
            <source>{value:.1f} mm is the least of its material</source>
            <translation>{value:.1f} mm är minst för dess material</translation>
        </message>
        <message>
            <source>{value:.1f} mm of rise over 1 mm</source>
            <translation>{value:.1f} mm stigning på 1 mm</translation>
        </message>
        <message>
            <source>{value:.1f} mm to spare</source>
            <translation>{value:.1f} mm till godo</translation>
        </message>
        <message>
            <source>{value:.1f} mm too large</source>
            <translation>{value:.1f} mm för stort</translation>
        </message>
        <message>
            <source>{value:.2f} mm of material is left in hollows</source>
            <translation>{value:.2f} mm material blir kvar i hålkälar</translation>
        </message>
        <message>
            <source>{value:g} mm between the points of the surface</source>
            <translation>{value:g} mm mellan ytans punkter</translation>
        </message>
        <message>
            <source>{walls} walls, {top} layers above and {bottom} below</source>
            <translation>{walls} väggar, {top} lager upptill och {bottom} nedtill</translation>
        </message>
    </context>
</TS>

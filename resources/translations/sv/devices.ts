<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>0 if unknown</source>
            <translation>0 om okänt</translation>
        </message>
        <message>
            <source>A body below the shell that tilts it and stands flat on the ground</source>
            <translation>En kil under skalet som lutar det och står plant på underlaget</translation>
        </message>
        <message>
            <source>Add a body weight</source>
            <translation>Lägg till en kroppsvikt</translation>
        </message>
        <message>
            <source>Add a material</source>
            <translation>Lägg till ett material</translation>
        </message>
        <message>
            <source>Add a station here</source>
            <translation>Lägg till en kantpunkt här</translation>
        </message>
        <message>
            <source>Add a station to the rim</source>
            <translation>Lägg till en kantpunkt</translation>
        </message>
        <message>
            <source>Advice</source>
            <translation>Råd</translation>
        </message>
        <message>
            <source>Apply</source>
            <translation>Använd</translation>
        </message>
        <message>
            <source>As scanned / designed</source>
            <translation>Som skannad / utformad</translation>
        </message>
        <message>
            <source>As scanned: the imprint of the foot</source>
            <translation>Som skannad: fotens avtryck</translation>
        </message>
        <message>
            <source>As scanned: the rim is that of the foot. Choose a device to design it.</source>
            <translation>Som skannad: kanten är fotens egen. Välj en inläggstyp för att utforma den.</translation>
        </message>
        <message>
            <source>At the front edge</source>
            <translation>Vid framkanten</translation>
        </message>
        <message>
            <source>At the usual place instead of the present one: {names}</source>
            <translation>På sin vanliga plats i stället för den nuvarande: {names}</translation>
        </message>
        <message>
            <source>Base form: {name}</source>
            <translation>Grundform: {name}</translation>
        </message>
        <message>
            <source>Base forms</source>
            <translation>Grundformer</translation>
        </message>
        <message>
            <source>Behind the heel</source>
            <translation>Bakom hälen</translation>
        </message>
        <message>
            <source>Change between the imprint of the foot and the designed device</source>
            <translation>Växla mellan fotens avtryck och det utformade inlägget</translation>
        </message>
        <message>
            <source>Change least and usual thickness of the clinic's materials</source>
            <translation>Ändra minsta och vanlig tjocklek för klinikens material</translation>
        </message>
        <message>
            <source>Change the rim</source>
            <translation>Ändra kanten</translation>
        </message>
        <message>
            <source>Change the table of materials</source>
            <translation>Ändra materialtabellen</translation>
        </message>
        <message>
            <source>Choose a device, a base form, or what is proposed for a finding</source>
            <translation>Välj en inläggstyp, en grundform eller det som föreslås för ett fynd</translation>
        </message>
        <message>
            <source>Choose a material first.</source>
            <translation>Välj ett material först.</translation>
        </message>
        <message>
            <source>Design the rim</source>
            <translation>Utforma kanten</translation>
        </message>
        <message>
            <source>Device of an insole</source>
            <translation>Inläggstyp</translation>
        </message>
        <message>
            <source>Device or finding</source>
            <translation>Inläggstyp eller fynd</translation>
        </message>
        <message>
            <source>Device or finding…</source>
            <translation>Inläggstyp eller fynd…</translation>
        </message>
        <message>
            <source>Device: {name}</source>
            <translation>Inläggstyp: {name}</translation>
        </message>
        <message>
            <source>Devices</source>
            <translation>Inläggstyper</translation>
        </message>
        <message>
            <source>Devices and findings</source>
            <translation>Inläggstyper och fynd</translation>
        </message>
        <message>
            <source>Drag a station of the rim to raise it, or along the edge; double click adds or removes one</source>
            <translation>Dra en kantpunkt för att höja den, eller längs kanten; dubbelklick lägger till eller tar bort en</translation>
        </message>
        <message>
            <source>Drag a station to shape the rim; double click adds one, Delete removes it</source>
            <translation>Dra en kantpunkt för att forma kanten; dubbelklick lägger till en, Delete tar bort den</translation>
        </message>
        <message>
            <source>Drag to move the front edge of the shell</source>
            <translation>Dra för att flytta skalets framkant</translation>
        </message>
        <message>
            <source>Drag to move the line at which the toe zone begins</source>
            <translation>Dra för att flytta linjen där tåzonen börjar</translation>
        </message>
        <message>
            <source>Drag to raise the rim here, or to move the station along the edge</source>
            <translation>Dra för att höja kanten här, eller för att flytta kantpunkten längs kanten</translation>
        </message>
        <message>
            <source>Edit the device</source>
            <translation>Ändra inläggstypen</translation>
        </message>
        <message>
            <source>Edit the finding</source>
            <translation>Redigera fyndet</translation>
        </message>
        <message>
            <source>Edit the post</source>
            <translation>Ändra kilen</translation>
        </message>
        <message>
            <source>Edit the shell</source>
            <translation>Ändra skalet</translation>
        </message>
        <message>
            <source>Edit this finding…</source>
            <translation>Redigera fyndet…</translation>
        </message>
        <message>
            <source>Expert: device</source>
            <translation>Expert: inläggstyp</translation>
        </message>
        <message>
            <source>Expert: shell</source>
            <translation>Expert: skal</translation>
        </message>
        <message>
            <source>Export the clinic's findings…</source>
            <translation>Exportera klinikens fynd…</translation>
        </message>
        <message>
            <source>Export this device…</source>
            <translation>Exportera inläggstypen…</translation>
        </message>
        <message>
            <source>Export this finding…</source>
            <translation>Exportera fyndet…</translation>
        </message>
        <message>
            <source>Export this table…</source>
            <translation>Exportera tabellen…</translation>
        </message>
        <message>
            <source>Finding: {name}</source>
            <translation>Fynd: {name}</translation>
        </message>
        <message>
            <source>Flank of the foot</source>
            <translation>Fotens sida</translation>
        </message>
        <message>
            <source>From material and body weight a thickness is proposed; the least thickness is kept everywhere. By hardness or modulus the change of the pressure is computed.</source>
            <translation>Av material och kroppsvikt föreslås en tjocklek; den minsta tjockleken hålls överallt. Efter hårdhet eller modul beräknas tryckets förändring.</translation>
        </message>
        <message>
            <source>From which, with the weight, a thickness is proposed</source>
            <translation>Av det och vikten föreslås en tjocklek</translation>
        </message>
        <message>
            <source>From {least} kg on, a thickness is proposed; 0 if unknown</source>
            <translation>Från {least} kg föreslås en tjocklek; 0 om okänd</translation>
        </message>
        <message>
            <source>Give the imprint a designed rim and toe zone</source>
            <translation>Ge avtrycket en utformad kant och tåzon</translation>
        </message>
        <message>
            <source>Hardness, Shore A</source>
            <translation>Hårdhet, Shore A</translation>
        </message>
        <message>
            <source>Height of the medial rim at its peak, over the heel's floor</source>
            <translation>Den mediala kantens höjd där den är högst, över hälens botten</translation>
        </message>
        <message>
            <source>Height of the rim along the edge</source>
            <translation>Kantens höjd runt inlägget</translation>
        </message>
        <message>
            <source>Height of the rim behind the heel over the heel's floor</source>
            <translation>Kantens höjd bakom hälen, över hälens botten</translation>
        </message>
        <message>
            <source>Import a device…</source>
            <translation>Importera en inläggstyp…</translation>
        </message>
        <message>
            <source>Import a table…</source>
            <translation>Importera en tabell…</translation>
        </message>
        <message>
            <source>Import findings…</source>
            <translation>Importera fynd…</translation>
        </message>
        <message>
            <source>Keep as a finding</source>
            <translation>Behåll som fynd</translation>
        </message>
        <message>
            <source>Keep this design as a finding…</source>
            <translation>Behåll ordinationen som fynd…</translation>
        </message>
        <message>
            <source>Keep this insole's form as a base</source>
            <translation>Behåll inläggets form som grundform</translation>
        </message>
        <message>
            <source>Keep this insole's form as a base…</source>
            <translation>Behåll inläggets form som grundform…</translation>
        </message>
        <message>
            <source>Keywords, with commas</source>
            <translation>Sökord, med komma</translation>
        </message>
        <message>
            <source>Make it the clinic's default</source>
            <translation>Gör den till klinikens förval</translation>
        </message>
        <message>
            <source>Materials</source>
            <translation>Material</translation>
        </message>
        <message>
            <source>Materials…</source>
            <translation>Material…</translation>
        </message>
        <message>
            <source>More</source>
            <translation>Mer</translation>
        </message>
        <message>
            <source>Move a station of the rim</source>
            <translation>Flytta en kantpunkt</translation>
        </message>
        <message>
            <source>Move the toe line</source>
            <translation>Flytta tålinjen</translation>
        </message>
        <message>
            <source>Move the trim line</source>
            <translation>Flytta framkantens linje</translation>
        </message>
        <message>
            <source>Name of the device</source>
            <translation>Inläggstypens namn</translation>
        </message>
        <message>
            <source>Name of the form</source>
            <translation>Grundformens namn</translation>
        </message>
        <message>
            <source>New designs start with: {name}</source>
            <translation>Nya ordinationer börjar med: {name}</translation>
        </message>
        <message>
            <source>Nothing holds these words; type others.</source>
            <translation>Inget innehåller dessa ord; skriv andra.</translation>
        </message>
        <message>
            <source>Of this foot alone, and not part of it: {names}</source>
            <translation>Gäller bara den här foten och följer inte med: {names}</translation>
        </message>
        <message>
            <source>Own material {number}</source>
            <translation>Eget material {number}</translation>
        </message>
        <message>
            <source>Post</source>
            <translation>Kil</translation>
        </message>
        <message>
            <source>Raise a station of the rim</source>
            <translation>Höj en kantpunkt</translation>
        </message>
        <message>
            <source>Remove a station of the rim</source>
            <translation>Ta bort en kantpunkt</translation>
        </message>
        <message>
            <source>Remove this body weight</source>
            <translation>Ta bort kroppsvikten</translation>
        </message>
        <message>
            <source>Remove this device</source>
            <translation>Ta bort inläggstypen</translation>
        </message>
        <message>
            <source>Remove this finding</source>
            <translation>Ta bort fyndet</translation>
        </message>
        <message>
            <source>Remove this station</source>
            <translation>Ta bort kantpunkten</translation>
        </message>
        <message>
            <source>Removed: {name}</source>
            <translation>Borttagen: {name}</translation>
        </message>
        <message>
            <source>Replace it</source>
            <translation>Ersätt</translation>
        </message>
        <message>
            <source>Return to the supplied findings</source>
            <translation>Återgå till de medföljande fynden</translation>
        </message>
        <message>
            <source>Rim</source>
            <translation>Kant</translation>
        </message>
        <message>
            <source>Save as a device</source>
            <translation>Spara som inläggstyp</translation>
        </message>
        <message>
            <source>Save the table</source>
            <translation>Spara tabellen</translation>
        </message>
        <message>
            <source>Save this design as a device…</source>
            <translation>Spara denna ordination som inläggstyp…</translation>
        </message>
        <message>
            <source>Search devices and findings</source>
            <translation>Sök inläggstyper och fynd</translation>
        </message>
        <message>
            <source>Shape the rim by its stations, in the views and in the graph below</source>
            <translation>Forma kanten med dess kantpunkter, i vyerna och i diagrammet nedan</translation>
        </message>
        <message>
            <source>Show the imprint of the foot, without a designed rim; once more brings it back</source>
            <translation>Visa fotens avtryck utan utformad kant; en gång till tar den tillbaka</translation>
        </message>
        <message>
            <source>Show the supplied materials</source>
            <translation>Visa de medföljande materialen</translation>
        </message>
        <message>
            <source>Source</source>
            <translation>Källa</translation>
        </message>
        <message>
            <source>Source: {source}</source>
            <translation>Källa: {source}</translation>
        </message>
        <message>
            <source>Stored: {name}</source>
            <translation>Sparad: {name}</translation>
        </message>
        <message>
            <source>Table of materials</source>
            <translation>Materialtabell</translation>
        </message>
        <message>
            <source>Table of materials…</source>
            <translation>Materialtabell…</translation>
        </message>
        <message>
            <source>Take the usual thickness</source>
            <translation>Ta den vanliga tjockleken</translation>
        </message>
        <message>
            <source>Take {thickness} mm</source>
            <translation>Ta {thickness} mm</translation>
        </message>
        <message>
            <source>The clinic has “{name}” already.</source>
            <translation>Kliniken har redan ”{name}”.</translation>
        </message>
        <message>
            <source>The design is like this already; nothing would change.</source>
            <translation>Ordinationen är redan sådan; inget skulle ändras.</translation>
        </message>
        <message>
            <source>The finding proposes:</source>
            <translation>Fyndet föreslår:</translation>
        </message>
        <message>
            <source>The foot itself</source>
            <translation>Foten själv</translation>
        </message>
        <message>
            <source>The insole follows the sole of the foot everywhere: total contact.</source>
            <translation>Inlägget följer fotsulan överallt: full kontakt.</translation>
        </message>
        <message>
            <source>The rim appears here as soon as there is a foot.</source>
            <translation>Kanten visas här så snart det finns en fot.</translation>
        </message>
        <message>
            <source>The supplied findings apply again; the clinic's are kept as {name}</source>
            <translation>De medföljande fynden gäller igen; klinikens finns kvar som {name}</translation>
        </message>
        <message>
            <source>The usual thickness for this material and weight</source>
            <translation>Den vanliga tjockleken för materialet och vikten</translation>
        </message>
        <message>
            <source>This insole is as scanned; choose a device to design its rim</source>
            <translation>Inlägget är som skannat; välj en inläggstyp för att utforma kanten</translation>
        </message>
        <message>
            <source>Type to search: cup, child, plantar fasciitis</source>
            <translation>Skriv för att söka: hälskål, barn, plantarfasciit</translation>
        </message>
        <message>
            <source>Usual thickness</source>
            <translation>Vanlig tjocklek</translation>
        </message>
        <message>
            <source>What the finding proposes stays. To change that, keep a design under its name.</source>
            <translation>Det som fyndet föreslår blir kvar. Behåll en ordination under dess namn för att ändra det.</translation>
        </message>
        <message>
            <source>What the layer is made of: by it, the change of the pressure is computed</source>
            <translation>Vad skiktet är gjort av: efter det beräknas tryckets förändring</translation>
        </message>
        <message>
            <source>Young's modulus</source>
            <translation>Elasticitetsmodul</translation>
        </message>
        <message>
            <source>above</source>
            <translation>över</translation>
        </message>
        <message>
            <source>for every body weight</source>
            <translation>för alla kroppsvikter</translation>
        </message>
        <message>
            <source>materials</source>
            <translation>material</translation>
        </message>
        <message>
            <source>mm over the heel</source>
            <translation>mm över hälen</translation>
        </message>
        <message>
            <source>not said</source>
            <translation>inte angivet</translation>
        </message>
        <message>
            <source>of this foot</source>
            <translation>för denna fot</translation>
        </message>
        <message>
            <source>over the foot's own surface</source>
            <translation>över fotens egen yta</translation>
        </message>
        <message>
            <source>over the heel</source>
            <translation>över hälen</translation>
        </message>
        <message>
            <source>over the toe zone</source>
            <translation>över tåzonen</translation>
        </message>
        <message>
            <source>own</source>
            <translation>egen</translation>
        </message>
        <message>
            <source>own findings</source>
            <translation>egna fynd</translation>
        </message>
        <message>
            <source>up to</source>
            <translation>upp till</translation>
        </message>
        <message>
            <source>{form}: at 0 % the form alone, at 100 % the sole of the foot</source>
            <translation>{form}: vid 0 % bara formen, vid 100 % fotens sula</translation>
        </message>
    </context>
</TS>

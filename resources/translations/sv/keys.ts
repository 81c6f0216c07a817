<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>Add a station midway to the next</source>
            <translation>Lägg till en station halvvägs till nästa</translation>
        </message>
        <message>
            <source>All that the keys do</source>
            <translation>Allt som tangenterna gör</translation>
        </message>
        <message>
            <source>Choose a date in the calendar</source>
            <translation>Välj ett datum i kalendern</translation>
        </message>
        <message>
            <source>Choose the next or previous handle or landmark; arrows drag it</source>
            <translation>Välj nästa eller föregående handtag eller landmärke; pilarna drar det</translation>
        </message>
        <message>
            <source>Choose the next or previous station</source>
            <translation>Välj nästa eller föregående station</translation>
        </message>
        <message>
            <source>Click where the cross is; end the drag; confirm the chosen landmark</source>
            <translation>Klicka där korset är; avsluta draget; bekräfta det valda landmärket</translation>
        </message>
        <message>
            <source>Close the window of a stage</source>
            <translation>Stäng ett stegs fönster</translation>
        </message>
        <message>
            <source>Drag a ring to turn the foot; hold Ctrl for small steps</source>
            <translation>Dra i en ring för att vrida foten; håll Ctrl för små steg</translation>
        </message>
        <message>
            <source>Empty the search line</source>
            <translation>Töm sökraden</translation>
        </message>
        <message>
            <source>Find this landmark anew</source>
            <translation>Sök detta landmärke på nytt</translation>
        </message>
        <message>
            <source>From the search line into the list</source>
            <translation>Från sökraden in i listan</translation>
        </message>
        <message>
            <source>Go on from a stage: to the design; export</source>
            <translation>Gå vidare från ett steg: till designen; exportera</translation>
        </message>
        <message>
            <source>Go to the numbers of what is selected</source>
            <translation>Gå till talen för det som är valt</translation>
        </message>
        <message>
            <source>Go to the thickness of the insole, whatever is selected</source>
            <translation>Gå till inläggets tjocklek, vad som än är valt</translation>
        </message>
        <message>
            <source>In every window</source>
            <translation>I varje fönster</translation>
        </message>
        <message>
            <source>In the fields</source>
            <translation>I fälten</translation>
        </message>
        <message>
            <source>In the graph of the rim</source>
            <translation>I kantens graf</translation>
        </message>
        <message>
            <source>In the views</source>
            <translation>I vyerna</translation>
        </message>
        <message>
            <source>Keys</source>
            <translation>Tangenter</translation>
        </message>
        <message>
            <source>Keys…</source>
            <translation>Tangenter…</translation>
        </message>
        <message>
            <source>Lead the keys to the next panel</source>
            <translation>Led tangenterna till nästa panel</translation>
        </message>
        <message>
            <source>Lead the keys to the panel before</source>
            <translation>Led tangenterna till föregående panel</translation>
        </message>
        <message>
            <source>Leave the number as it was; back to the view</source>
            <translation>Lämna talet som det var; tillbaka till vyn</translation>
        </message>
        <message>
            <source>Manual</source>
            <translation>Handbok</translation>
        </message>
        <message>
            <source>Move it along the edge</source>
            <translation>Flytta den längs kanten</translation>
        </message>
        <message>
            <source>Move what is selected by 0.5 mm; Shift 5 mm, Ctrl 0.05 mm</source>
            <translation>Flytta det valda 0,5 mm; Skift 5 mm, Ctrl 0,05 mm</translation>
        </message>
        <message>
            <source>Next panel</source>
            <translation>Nästa panel</translation>
        </message>
        <message>
            <source>No scan yet. Capture a foot, open a recorded session, or import a scan.</source>
            <translation>Ingen skanning än. Avbilda en fot, öppna en inspelad session eller importera en skanning.</translation>
        </message>
        <message>
            <source>On the pages of the record</source>
            <translation>På journalens sidor</translation>
        </message>
        <message>
            <source>One step more or less; with Shift ten, with Ctrl a tenth</source>
            <translation>Ett steg mer eller mindre; med Skift tio, med Ctrl en tiondel</translation>
        </message>
        <message>
            <source>Open a menu by its underlined letter</source>
            <translation>Öppna en meny med dess understrukna bokstav</translation>
        </message>
        <message>
            <source>Open the first of the found patients</source>
            <translation>Öppna den första träffen</translation>
        </message>
        <message>
            <source>Open the row of a list</source>
            <translation>Öppna raden i en lista</translation>
        </message>
        <message>
            <source>Pad of the library</source>
            <translation>Pelott ur biblioteket</translation>
        </message>
        <message>
            <source>Panel before</source>
            <translation>Föregående panel</translation>
        </message>
        <message>
            <source>Press and hold where the cross is, or let go: draw, brush</source>
            <translation>Håll nere där korset är, eller släpp: rita, pensla</translation>
        </message>
        <message>
            <source>Raise or lower it by 0.5 mm; Shift 5 mm, Ctrl 0.05 mm</source>
            <translation>Höj eller sänk den 0,5 mm; Skift 5 mm, Ctrl 0,05 mm</translation>
        </message>
        <message>
            <source>Raise or lower what is selected; with Ctrl finely. Else zoom</source>
            <translation>Höj eller sänk det valda; med Ctrl fint. Annars zooma</translation>
        </message>
        <message>
            <source>Remove it</source>
            <translation>Ta bort den</translation>
        </message>
        <message>
            <source>Remove the pad</source>
            <translation>Ta bort pelotten</translation>
        </message>
        <message>
            <source>Remove the section</source>
            <translation>Ta bort snittet</translation>
        </message>
        <message>
            <source>Remove what is chosen, else the selected correction</source>
            <translation>Ta bort det som är valt, annars den valda korrigeringen</translation>
        </message>
        <message>
            <source>Search</source>
            <translation>Sök</translation>
        </message>
        <message>
            <source>Select the correction before</source>
            <translation>Välj föregående korrigering</translation>
        </message>
        <message>
            <source>Select the next correction</source>
            <translation>Välj nästa korrigering</translation>
        </message>
        <message>
            <source>Select what stands above in the list</source>
            <translation>Välj det som står ovanför i listan</translation>
        </message>
        <message>
            <source>Select what stands below in the list</source>
            <translation>Välj det som står nedanför i listan</translation>
        </message>
        <message>
            <source>Take the number that was typed</source>
            <translation>Ta talet som skrevs</translation>
        </message>
        <message>
            <source>The cross to where the tool is usually used</source>
            <translation>Korset till verktygets vanliga plats</translation>
        </message>
        <message>
            <source>The landmarks stand where they do on no foot; put them right first</source>
            <translation>Landmärkena står som på ingen fot; rätta dem först</translation>
        </message>
        <message>
            <source>The next field, the one before</source>
            <translation>Nästa fält, föregående fält</translation>
        </message>
        <message>
            <source>The page of the manual about what is in front</source>
            <translation>Handbokens sida om det som är framme</translation>
        </message>
        <message>
            <source>Turn foot</source>
            <translation>Vrid foten</translation>
        </message>
        <message>
            <source>Turn the foot</source>
            <translation>Vrid foten</translation>
        </message>
        <message>
            <source>Turn the foot by rings; type its angles, or align it by the landmarks</source>
            <translation>Vrid foten med ringar; skriv dess vinklar, eller rikta den efter landmärkena</translation>
        </message>
        <message>
            <source>Turn the view; with Shift, shift it</source>
            <translation>Rotera vyn; med Skift, flytta den</translation>
        </message>
        <message>
            <source>Type the thickness</source>
            <translation>Skriv tjockleken</translation>
        </message>
        <message>
            <source>Type the values</source>
            <translation>Skriv värdena</translation>
        </message>
        <message>
            <source>Undo the drag; back to the view</source>
            <translation>Ångra draget; tillbaka till vyn</translation>
        </message>
        <message>
            <source>Undo the drag; nothing chosen; nothing selected; the Orbit tool</source>
            <translation>Ångra draget; inget valt; inget markerat; verktyget Rotera</translation>
        </message>
        <message>
            <source>What can be done here</source>
            <translation>Vad som kan göras här</translation>
        </message>
        <message>
            <source>Work on this foot</source>
            <translation>Arbeta med denna fot</translation>
        </message>
        <message>
            <source>Write the files for the shop</source>
            <translation>Skriv filerna till verkstaden</translation>
        </message>
        <message>
            <source>{angle}: drag along the ring</source>
            <translation>{angle}: dra längs ringen</translation>
        </message>
    </context>
</TS>

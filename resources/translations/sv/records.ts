<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv">
    <context>
        <name>insole_studio</name>
        <message>
            <source>&amp;New orders are due after</source>
            <translation>&amp;Nya beställningar ska vara klara efter</translation>
        </message>
        <message>
            <source>A copy was written: {name}</source>
            <translation>En kopia skrevs: {name}</translation>
        </message>
        <message>
            <source>A new capture of this visit has come from {who} at {time}.</source>
            <translation>En ny avbildning av detta besök har kommit från {who} klockan {time}.</translation>
        </message>
        <message>
            <source>A scan of this visit is prescribed as last time: {feet}. Capture or import it.</source>
            <translation>En skanning av det här besöket ordineras som förra gången: {feet}. Avbilda eller importera den.</translation>
        </message>
        <message>
            <source>Add a patient to the clinic's record</source>
            <translation>Lägg till en patient i klinikens journal</translation>
        </message>
        <message>
            <source>Add a photo…</source>
            <translation>Lägg till ett foto…</translation>
        </message>
        <message>
            <source>Add a visit of today for the patient on the page, and open it</source>
            <translation>Lägg till ett besök i dag för patienten på sidan, och öppna det</translation>
        </message>
        <message>
            <source>Add a visit of today, to be prescribed as the last one on a new scan</source>
            <translation>Lägg till ett besök i dag som ordineras som det förra på en ny skanning</translation>
        </message>
        <message>
            <source>Add another patient</source>
            <translation>Lägg till en annan patient</translation>
        </message>
        <message>
            <source>Add as a new patient</source>
            <translation>Lägg till som ny patient</translation>
        </message>
        <message>
            <source>Add follow-up</source>
            <translation>Lägg till uppföljning</translation>
        </message>
        <message>
            <source>Add nobody</source>
            <translation>Lägg inte till någon</translation>
        </message>
        <message>
            <source>Add patient</source>
            <translation>Lägg till patient</translation>
        </message>
        <message>
            <source>Add to the record</source>
            <translation>Lägg till i journalen</translation>
        </message>
        <message>
            <source>Add to the record…</source>
            <translation>Lägg till i journalen…</translation>
        </message>
        <message>
            <source>Add to this patient</source>
            <translation>Lägg till hos denna patient</translation>
        </message>
        <message>
            <source>Adjusted</source>
            <translation>Justerad</translation>
        </message>
        <message>
            <source>All orders</source>
            <translation>Alla beställningar</translation>
        </message>
        <message>
            <source>An administrator looks after accounts, backups and the audit log, and sees no patients; whoever treats patients signs in with an account of their own.</source>
            <translation>En administratör sköter konton, säkerhetskopior och loggen och ser inga patienter; den som behandlar patienter loggar in med ett eget konto.</translation>
        </message>
        <message>
            <source>An invented patient to try the program with; comes back if it was removed</source>
            <translation>En påhittad patient att prova programmet med; kommer tillbaka om den tagits bort</translation>
        </message>
        <message>
            <source>Anna Example (sample patient)</source>
            <translation>Anna Exempel (provpatient)</translation>
        </message>
        <message>
            <source>Another scan</source>
            <translation>En annan skanning</translation>
        </message>
        <message>
            <source>Another size</source>
            <translation>Annan storlek</translation>
        </message>
        <message>
            <source>Arch height (mm)</source>
            <translation>Valvhöjd (mm)</translation>
        </message>
        <message>
            <source>Ball width (mm)</source>
            <translation>Trampdynans bredd (mm)</translation>
        </message>
        <message>
            <source>Begin a visit, or open one, first.</source>
            <translation>Börja ett besök, eller öppna ett, först.</translation>
        </message>
        <message>
            <source>Begun</source>
            <translation>Påbörjat</translation>
        </message>
        <message>
            <source>Better, the same, worse; in a word or two</source>
            <translation>Bättre, oförändrat, sämre; med ett par ord</translation>
        </message>
        <message>
            <source>Between two pieces: for a router more than its cutter</source>
            <translation>Mellan två stycken: för en fräsmaskin mer än dess fräs</translation>
        </message>
        <message>
            <source>Both, one below the other</source>
            <translation>Båda, under varandra</translation>
        </message>
        <message>
            <source>Bring to this state</source>
            <translation>Sätt i detta läge</translation>
        </message>
        <message>
            <source>By</source>
            <translation>Av</translation>
        </message>
        <message>
            <source>Cancel the order</source>
            <translation>Makulera beställningen</translation>
        </message>
        <message>
            <source>Cancelled</source>
            <translation>Makulerad</translation>
        </message>
        <message>
            <source>Caption</source>
            <translation>Bildtext</translation>
        </message>
        <message>
            <source>Capture: {state}</source>
            <translation>Avbildning: {state}</translation>
        </message>
        <message>
            <source>Captured</source>
            <translation>Avbildad</translation>
        </message>
        <message>
            <source>Captured {time}; calibration of the sensors not recorded</source>
            <translation>Avbildad {time}; sensorernas kalibrering är inte antecknad</translation>
        </message>
        <message>
            <source>Captured {time}; sensors calibrated {day}</source>
            <translation>Avbildad {time}; sensorerna kalibrerade {day}</translation>
        </message>
        <message>
            <source>Cases in files can be opened as before.</source>
            <translation>Fall i filer kan öppnas som förut.</translation>
        </message>
        <message>
            <source>Changed</source>
            <translation>Ändrad</translation>
        </message>
        <message>
            <source>Checked</source>
            <translation>Kontrollerad</translation>
        </message>
        <message>
            <source>Choose a mark first, or draw one.</source>
            <translation>Välj ett märke först, eller rita ett.</translation>
        </message>
        <message>
            <source>Choose a patient in the list first.</source>
            <translation>Välj först en patient i listan.</translation>
        </message>
        <message>
            <source>Choose a photo first.</source>
            <translation>Välj ett foto först.</translation>
        </message>
        <message>
            <source>Choose a version first.</source>
            <translation>Välj en version först.</translation>
        </message>
        <message>
            <source>Choose an order in the list first.</source>
            <translation>Välj en beställning i listan först.</translation>
        </message>
        <message>
            <source>Choose between two versions of the patient's fields</source>
            <translation>Välj mellan två versioner av patientens fält</translation>
        </message>
        <message>
            <source>Choose in the calendar (F4)</source>
            <translation>Välj i kalendern (F4)</translation>
        </message>
        <message>
            <source>Choose two visits to compare them</source>
            <translation>Välj två besök för att jämföra dem</translation>
        </message>
        <message>
            <source>Choose what goes on; the other version stays in the history.</source>
            <translation>Välj vad som gäller; den andra versionen finns kvar i historiken.</translation>
        </message>
        <message>
            <source>Close</source>
            <translation>Stäng</translation>
        </message>
        <message>
            <source>Compare</source>
            <translation>Jämför</translation>
        </message>
        <message>
            <source>Compare two visits…</source>
            <translation>Jämför två besök…</translation>
        </message>
        <message>
            <source>Decide later</source>
            <translation>Bestäm senare</translation>
        </message>
        <message>
            <source>Decide…</source>
            <translation>Bestäm…</translation>
        </message>
        <message>
            <source>Delete</source>
            <translation>Ta bort</translation>
        </message>
        <message>
            <source>Delete the photo…</source>
            <translation>Ta bort fotot…</translation>
        </message>
        <message>
            <source>Deletes a visit that holds nothing; any other one is kept</source>
            <translation>Tar bort ett besök som inte innehåller något; alla andra finns kvar</translation>
        </message>
        <message>
            <source>Delivered</source>
            <translation>Levererad</translation>
        </message>
        <message>
            <source>Designed</source>
            <translation>Utformad</translation>
        </message>
        <message>
            <source>Drag to draw a line, click to mark a place; then write the text.</source>
            <translation>Dra för att rita en linje, klicka för att märka ett ställe; skriv sedan texten.</translation>
        </message>
        <message>
            <source>Edit…</source>
            <translation>Redigera…</translation>
        </message>
        <message>
            <source>Engrave order and side into the undersides</source>
            <translation>Gravera beställning och sida i undersidorna</translation>
        </message>
        <message>
            <source>Follow-ups so far</source>
            <translation>Uppföljningar hittills</translation>
        </message>
        <message>
            <source>Follow-up…</source>
            <translation>Uppföljning…</translation>
        </message>
        <message>
            <source>Foot length (mm)</source>
            <translation>Fotlängd (mm)</translation>
        </message>
        <message>
            <source>Forefoot pain when walking.</source>
            <translation>Smärta i framfoten vid gång.</translation>
        </message>
        <message>
            <source>Found patients</source>
            <translation>Funna patienter</translation>
        </message>
        <message>
            <source>From the pieces to the sides of the block</source>
            <translation>Från styckena till blockets sidor</translation>
        </message>
        <message>
            <source>From theirs to mine</source>
            <translation>Från deras till min</translation>
        </message>
        <message>
            <source>Gap</source>
            <translation>Avstånd</translation>
        </message>
        <message>
            <source>Go on with mine</source>
            <translation>Fortsätt med min</translation>
        </message>
        <message>
            <source>Go on with theirs</source>
            <translation>Fortsätt med deras</translation>
        </message>
        <message>
            <source>Heel width (mm)</source>
            <translation>Hälbredd (mm)</translation>
        </message>
        <message>
            <source>Import a scan…</source>
            <translation>Importera en skanning…</translation>
        </message>
        <message>
            <source>In production</source>
            <translation>I produktion</translation>
        </message>
        <message>
            <source>Invented, to try the program with: nothing here concerns a real person.</source>
            <translation>Påhittad, för att prova programmet: inget här gäller en verklig person.</translation>
        </message>
        <message>
            <source>Its program is written beside the solids</source>
            <translation>Dess program skrivs bredvid styckena</translation>
        </message>
        <message>
            <source>Keep</source>
            <translation>Behåll</translation>
        </message>
        <message>
            <source>Keep as a new visit</source>
            <translation>Behåll som nytt besök</translation>
        </message>
        <message>
            <source>Keep both as variants</source>
            <translation>Behåll båda som varianter</translation>
        </message>
        <message>
            <source>Keep the sample patient</source>
            <translation>Behåll provpatienten</translation>
        </message>
        <message>
            <source>Keep theirs</source>
            <translation>Behåll deras</translation>
        </message>
        <message>
            <source>Keep this version</source>
            <translation>Behåll denna version</translation>
        </message>
        <message>
            <source>Keeping your work here…</source>
            <translation>Ditt arbete sparas undan här …</translation>
        </message>
        <message>
            <source>Kept</source>
            <translation>Behållen</translation>
        </message>
        <message>
            <source>Last visit</source>
            <translation>Senaste besök</translation>
        </message>
        <message>
            <source>Left foot not scanned: mirrored from the right</source>
            <translation>Vänster fot inte skannad: speglad från höger</translation>
        </message>
        <message>
            <source>Make a foot of it</source>
            <translation>Gör en fot av den</translation>
        </message>
        <message>
            <source>Make a visit of the open case; its file stays as it is</source>
            <translation>Gör det öppna fallet till ett besök; filen förblir som den är</translation>
        </message>
        <message>
            <source>Marks</source>
            <translation>Märken</translation>
        </message>
        <message>
            <source>Measure over time</source>
            <translation>Mått över tid</translation>
        </message>
        <message>
            <source>Mine</source>
            <translation>Min</translation>
        </message>
        <message>
            <source>My value</source>
            <translation>Mitt värde</translation>
        </message>
        <message>
            <source>Name, birth date, personal number or order</source>
            <translation>Namn, födelsedatum, personnummer eller beställning</translation>
        </message>
        <message>
            <source>Navicular height (mm)</source>
            <translation>Naviculares höjd (mm)</translation>
        </message>
        <message>
            <source>Nest the orders</source>
            <translation>Lägg ut beställningarna</translation>
        </message>
        <message>
            <source>Nest the orders…</source>
            <translation>Lägg ut beställningarna…</translation>
        </message>
        <message>
            <source>Nest…</source>
            <translation>Lägg ut…</translation>
        </message>
        <message>
            <source>New patient</source>
            <translation>Ny patient</translation>
        </message>
        <message>
            <source>New patient…</source>
            <translation>Ny patient…</translation>
        </message>
        <message>
            <source>New state</source>
            <translation>Nytt läge</translation>
        </message>
        <message>
            <source>New visit</source>
            <translation>Nytt besök</translation>
        </message>
        <message>
            <source>New visit, same prescription</source>
            <translation>Nytt besök, samma ordination</translation>
        </message>
        <message>
            <source>No difference that can be seen</source>
            <translation>Ingen skillnad som syns</translation>
        </message>
        <message>
            <source>No patient yet. Begin with “New patient”, or open a file.</source>
            <translation>Ingen patient än. Börja med ”Ny patient”, eller öppna en fil.</translation>
        </message>
        <message>
            <source>No photo yet. Add a JPEG or PNG of camera or phone.</source>
            <translation>Inget foto än. Lägg till en JPEG eller PNG från kamera eller telefon.</translation>
        </message>
        <message>
            <source>No router</source>
            <translation>Ingen fräsmaskin</translation>
        </message>
        <message>
            <source>No visit yet. Begin with “New visit”.</source>
            <translation>Inget besök än. Börja med ”Nytt besök”.</translation>
        </message>
        <message>
            <source>No.</source>
            <translation>Nr</translation>
        </message>
        <message>
            <source>Nobody is found. Check the spelling, or add a new patient.</source>
            <translation>Ingen hittas. Kontrollera stavningen, eller lägg till en ny patient.</translation>
        </message>
        <message>
            <source>Nobody of the work list</source>
            <translation>Ingen på arbetslistan</translation>
        </message>
        <message>
            <source>Not saved and not kept here yet</source>
            <translation>Varken sparat eller undansparat här än</translation>
        </message>
        <message>
            <source>Not saved in the record; your work is kept here</source>
            <translation>Inte sparat i journalen; ditt arbete finns kvar här</translation>
        </message>
        <message>
            <source>Not saved yet: the database does not answer; your work is kept here</source>
            <translation>Inte sparat än: databasen svarar inte; ditt arbete finns kvar här</translation>
        </message>
        <message>
            <source>Not saved yet: two versions, decide</source>
            <translation>Inte sparat än: två versioner, bestäm</translation>
        </message>
        <message>
            <source>Nothing can be changed in the record at the moment.</source>
            <translation>Inget kan ändras i journalen just nu.</translation>
        </message>
        <message>
            <source>Nothing was prescribed for this patient before; a scan begins anew.</source>
            <translation>Inget har ordinerats för den här patienten tidigare; en skanning börjar om från början.</translation>
        </message>
        <message>
            <source>Nothing was prescribed on an earlier visit.</source>
            <translation>Inget ordinerades vid något tidigare besök.</translation>
        </message>
        <message>
            <source>One order</source>
            <translation>En beställning</translation>
        </message>
        <message>
            <source>One piece is nested in {name}.</source>
            <translation>Ett stycke är utlagt i {name}.</translation>
        </message>
        <message>
            <source>Open a visit first.</source>
            <translation>Öppna ett besök först.</translation>
        </message>
        <message>
            <source>Open at the moment: {who}</source>
            <translation>Öppet just nu: {who}</translation>
        </message>
        <message>
            <source>Open its visit, and export the next revision of its files</source>
            <translation>Öppna dess besök och exportera nästa revision av filerna</translation>
        </message>
        <message>
            <source>Open orders</source>
            <translation>Öppna beställningar</translation>
        </message>
        <message>
            <source>Open the folder</source>
            <translation>Öppna mappen</translation>
        </message>
        <message>
            <source>Open the newer version</source>
            <translation>Öppna den nyare versionen</translation>
        </message>
        <message>
            <source>Open the visit</source>
            <translation>Öppna besöket</translation>
        </message>
        <message>
            <source>Open this patient</source>
            <translation>Öppna denna patient</translation>
        </message>
        <message>
            <source>Order {number}</source>
            <translation>Beställning {number}</translation>
        </message>
        <message>
            <source>Order {number} was cancelled, or is not the last one of its visit, and gets no revision; open the visit and export a new order.</source>
            <translation>Beställning {number} har makulerats, eller är inte den sista för besöket, och får ingen revision; öppna besöket och exportera en ny beställning.</translation>
        </message>
        <message>
            <source>Order {number} was written without files.</source>
            <translation>Beställning {number} skrevs utan filer.</translation>
        </message>
        <message>
            <source>Order {number}: {state}.</source>
            <translation>Beställning {number}: {state}.</translation>
        </message>
        <message>
            <source>Ordered</source>
            <translation>Beställd</translation>
        </message>
        <message>
            <source>Orders of the patient</source>
            <translation>Patientens beställningar</translation>
        </message>
        <message>
            <source>Orders of {name}</source>
            <translation>Beställningar för {name}</translation>
        </message>
        <message>
            <source>Other marks on the foot</source>
            <translation>Andra märken på foten</translation>
        </message>
        <message>
            <source>Other variants</source>
            <translation>Andra varianter</translation>
        </message>
        <message>
            <source>Patient, order or shop</source>
            <translation>Patient, beställning eller verkstad</translation>
        </message>
        <message>
            <source>Patients</source>
            <translation>Patienter</translation>
        </message>
        <message>
            <source>Patients whose feet wait to be captured</source>
            <translation>Patienter vars fötter väntar på avbildning</translation>
        </message>
        <message>
            <source>Photos</source>
            <translation>Foton</translation>
        </message>
        <message>
            <source>Photos ({count})…</source>
            <translation>Foton ({count})…</translation>
        </message>
        <message>
            <source>Photos of the open visit, to draw and write on</source>
            <translation>Foton från det öppna besöket, att rita och skriva på</translation>
        </message>
        <message>
            <source>Photos of the visit</source>
            <translation>Foton från besöket</translation>
        </message>
        <message>
            <source>Photos of the visit…</source>
            <translation>Foton från besöket…</translation>
        </message>
        <message>
            <source>Photos…</source>
            <translation>Foton…</translation>
        </message>
        <message>
            <source>Prescribe as on the last visit</source>
            <translation>Ordinera som vid förra besöket</translation>
        </message>
        <message>
            <source>Print the papers…</source>
            <translation>Skriv ut pappren…</translation>
        </message>
        <message>
            <source>Read it so</source>
            <translation>Läs den så</translation>
        </message>
        <message>
            <source>Recent patients</source>
            <translation>Senaste patienter</translation>
        </message>
        <message>
            <source>Remember the last prescription</source>
            <translation>Kom ihåg den förra ordinationen</translation>
        </message>
        <message>
            <source>Remind me in a week</source>
            <translation>Påminn mig om en vecka</translation>
        </message>
        <message>
            <source>Remove the invented patient and all that was tried on it</source>
            <translation>Ta bort den påhittade patienten och allt som provats på den</translation>
        </message>
        <message>
            <source>Remove the mark</source>
            <translation>Ta bort märket</translation>
        </message>
        <message>
            <source>Remove the sample patient…</source>
            <translation>Ta bort provpatienten…</translation>
        </message>
        <message>
            <source>Returned</source>
            <translation>Returnerad</translation>
        </message>
        <message>
            <source>Revise…</source>
            <translation>Revidera…</translation>
        </message>
        <message>
            <source>Right foot not scanned: mirrored from the left</source>
            <translation>Höger fot inte skannad: speglad från vänster</translation>
        </message>
        <message>
            <source>Router</source>
            <translation>Fräsmaskin</translation>
        </message>
        <message>
            <source>Sample patient</source>
            <translation>Provpatient</translation>
        </message>
        <message>
            <source>Sample: an invented patient to try things on; nothing here is real.</source>
            <translation>Prov: en påhittad patient att prova på; inget här är på riktigt.</translation>
        </message>
        <message>
            <source>Save as a file…</source>
            <translation>Spara som fil…</translation>
        </message>
        <message>
            <source>Saved in the record</source>
            <translation>Sparat i journalen</translation>
        </message>
        <message>
            <source>Saving…</source>
            <translation>Sparar…</translation>
        </message>
        <message>
            <source>Scan of the visit of {day}, used once more</source>
            <translation>Skanning från besöket {day}, använd en gång till</translation>
        </message>
        <message>
            <source>Scan {name}, {time}</source>
            <translation>Skanning {name}, {time}</translation>
        </message>
        <message>
            <source>Search for a patient; today's visits and open orders</source>
            <translation>Sök en patient; dagens besök och öppna beställningar</translation>
        </message>
        <message>
            <source>Search patients</source>
            <translation>Sök patienter</translation>
        </message>
        <message>
            <source>Search the orders</source>
            <translation>Sök bland beställningarna</translation>
        </message>
        <message>
            <source>Sent</source>
            <translation>Skickad</translation>
        </message>
        <message>
            <source>Shop and due date…</source>
            <translation>Verkstad och klardatum…</translation>
        </message>
        <message>
            <source>Show more</source>
            <translation>Visa fler</translation>
        </message>
        <message>
            <source>Sign this version</source>
            <translation>Signera denna version</translation>
        </message>
        <message>
            <source>Signed</source>
            <translation>Signerad</translation>
        </message>
        <message>
            <source>Somebody else has changed the left foot of this visit while you worked on it.</source>
            <translation>Någon annan har ändrat besökets vänstra fot medan du arbetade med den.</translation>
        </message>
        <message>
            <source>Somebody else has changed the right foot of this visit while you worked on it.</source>
            <translation>Någon annan har ändrat besökets högra fot medan du arbetade med den.</translation>
        </message>
        <message>
            <source>Somebody else has changed the same fields while you worked on them. Choose which value counts; all others of your changes are stored.</source>
            <translation>Någon annan har ändrat samma fält medan du arbetade med dem. Välj vilket värde som gäller; alla dina andra ändringar sparas.</translation>
        </message>
        <message>
            <source>Somebody who is there twice has only a part of the visits in each place.</source>
            <translation>Den som finns två gånger har bara en del av besöken på varje ställe.</translation>
        </message>
        <message>
            <source>State</source>
            <translation>Läge</translation>
        </message>
        <message>
            <source>Store</source>
            <translation>Spara</translation>
        </message>
        <message>
            <source>Text of the mark</source>
            <translation>Märkets text</translation>
        </message>
        <message>
            <source>The capture is in the record.</source>
            <translation>Avbildningen finns i journalen.</translation>
        </message>
        <message>
            <source>The capture room has to capture the feet</source>
            <translation>Avbildningsrummet ska avbilda fötterna</translation>
        </message>
        <message>
            <source>The empty visit of {day} is deleted.</source>
            <translation>Det tomma besöket den {day} är borttaget.</translation>
        </message>
        <message>
            <source>The file does not tell how its letters are stored. Which names are right?</source>
            <translation>Filen säger inte hur dess bokstäver är lagrade. Vilka namn är rätt?</translation>
        </message>
        <message>
            <source>The files of order {number} are copied from the record; choose where to</source>
            <translation>Filerna i beställning {number} kopieras från journalen; välj vart</translation>
        </message>
        <message>
            <source>The first version of this foot.</source>
            <translation>Fotens första version.</translation>
        </message>
        <message>
            <source>The first {shown} of {count} orders</source>
            <translation>De första {shown} av {count} beställningar</translation>
        </message>
        <message>
            <source>The orders of the clinic by state, the first due on top</source>
            <translation>Klinikens beställningar efter läge, de som är klara först överst</translation>
        </message>
        <message>
            <source>The orders of the patient on the page</source>
            <translation>Beställningarna för patienten på sidan</translation>
        </message>
        <message>
            <source>The patient agrees that these data are kept (today)</source>
            <translation>Patienten samtycker till att uppgifterna sparas (i dag)</translation>
        </message>
        <message>
            <source>The pieces of several orders on one block or sheet</source>
            <translation>Stycken av flera beställningar på ett block eller en skiva</translation>
        </message>
        <message>
            <source>The record has this name and birth date already: {person}.</source>
            <translation>Journalen har redan detta namn och födelsedatum: {person}.</translation>
        </message>
        <message>
            <source>The sample patient and everything that was tried on it will be removed. Help ▸ Sample patient brings a new one back.</source>
            <translation>Provpatienten och allt som provats på den tas bort. Hjälp ▸ Provpatient hämtar tillbaka en ny.</translation>
        </message>
        <message>
            <source>The sample patient is removed; Help ▸ Sample patient brings it back.</source>
            <translation>Provpatienten är borttagen; Hjälp ▸ Provpatient hämtar tillbaka den.</translation>
        </message>
        <message>
            <source>The visit is open in another window of this computer; close it there before it is deleted.</source>
            <translation>Besöket är öppet i ett annat fönster på den här datorn; stäng det där innan det tas bort.</translation>
        </message>
        <message>
            <source>Their value</source>
            <translation>Deras värde</translation>
        </message>
        <message>
            <source>Theirs</source>
            <translation>Deras</translation>
        </message>
        <message>
            <source>There is no order in the list.</source>
            <translation>Det finns ingen beställning i listan.</translation>
        </message>
        <message>
            <source>This order was written without papers.</source>
            <translation>Den här beställningen skrevs utan papper.</translation>
        </message>
        <message>
            <source>This prescription was changed elsewhere: a newer version than this is stored.</source>
            <translation>Ordinationen ändrades på annat håll: en nyare version än denna är sparad.</translation>
        </message>
        <message>
            <source>This version is signed already.</source>
            <translation>Den här versionen är redan signerad.</translation>
        </message>
        <message>
            <source>This visit has no foot yet.</source>
            <translation>Besöket har ingen fot ännu.</translation>
        </message>
        <message>
            <source>This visit has no scan yet; the last one is of {day}.</source>
            <translation>Det här besöket har ingen skanning än; den senaste är från {day}.</translation>
        </message>
        <message>
            <source>This visit is open elsewhere too: {who}. Nothing gets lost.</source>
            <translation>Besöket är öppet även på annat håll: {who}. Inget går förlorat.</translation>
        </message>
        <message>
            <source>This visit was deleted elsewhere: keep what you have made as a new visit, or save it as a file.</source>
            <translation>Detta besök togs bort på ett annat ställe: behåll det du har gjort som ett nytt besök, eller spara det som en fil.</translation>
        </message>
        <message>
            <source>This visit was deleted elsewhere; what you have made is kept on this computer.</source>
            <translation>Detta besök togs bort på ett annat ställe; det du har gjort finns kvar på den här datorn.</translation>
        </message>
        <message>
            <source>Tick at least one order.</source>
            <translation>Kryssa för minst en beställning.</translation>
        </message>
        <message>
            <source>To the sides</source>
            <translation>Till sidorna</translation>
        </message>
        <message>
            <source>Today's visits</source>
            <translation>Dagens besök</translation>
        </message>
        <message>
            <source>Two versions of the same fields</source>
            <translation>Två versioner av samma fält</translation>
        </message>
        <message>
            <source>Two versions of the same foot</source>
            <translation>Två versioner av samma fot</translation>
        </message>
        <message>
            <source>Two versions of this foot wait for a decision; yours is kept on this computer.</source>
            <translation>Två versioner av foten väntar på ett beslut; din finns kvar på den här datorn.</translation>
        </message>
        <message>
            <source>Type the outcome first.</source>
            <translation>Skriv resultatet först.</translation>
        </message>
        <message>
            <source>Use the earlier scan</source>
            <translation>Använd den tidigare skanningen</translation>
        </message>
        <message>
            <source>Use the scan of {day}</source>
            <translation>Använd skanningen från {day}</translation>
        </message>
        <message>
            <source>Version {number}</source>
            <translation>Version {number}</translation>
        </message>
        <message>
            <source>Versions</source>
            <translation>Versioner</translation>
        </message>
        <message>
            <source>Versions…</source>
            <translation>Versioner…</translation>
        </message>
        <message>
            <source>Waiting</source>
            <translation>Väntar</translation>
        </message>
        <message>
            <source>What became of the insoles of the patient on the page</source>
            <translation>Hur det gick med inläggen för patienten på sidan</translation>
        </message>
        <message>
            <source>What was drawn on a photo and not saved yet is now in the record.</source>
            <translation>Det som ritades på ett foto och inte var sparat är nu i journalen.</translation>
        </message>
        <message>
            <source>Which orders</source>
            <translation>Vilka beställningar</translation>
        </message>
        <message>
            <source>Whose case is it? It becomes a visit; the file stays as it is.</source>
            <translation>Vems fall är det? Det blir ett besök; filen förblir som den är.</translation>
        </message>
        <message>
            <source>Whose feet are captured</source>
            <translation>Vems fötter som avbildas</translation>
        </message>
        <message>
            <source>Why is it kept? The next change begins a new version.</source>
            <translation>Varför behålls den? Nästa ändring börjar en ny version.</translation>
        </message>
        <message>
            <source>Without a patient, or from files</source>
            <translation>Utan patient, eller från filer</translation>
        </message>
        <message>
            <source>days</source>
            <translation>dagar</translation>
        </message>
        <message>
            <source>in another window of this computer</source>
            <translation>i ett annat fönster på den här datorn</translation>
        </message>
        <message>
            <source>left: {words}</source>
            <translation>vänster: {words}</translation>
        </message>
        <message>
            <source>nest</source>
            <translation>samläggning</translation>
        </message>
        <message>
            <source>no corrections</source>
            <translation>inga korrigeringar</translation>
        </message>
        <message>
            <source>no due date</source>
            <translation>inget datum</translation>
        </message>
        <message>
            <source>right: {words}</source>
            <translation>höger: {words}</translation>
        </message>
        <message>
            <source>signed by {name}</source>
            <translation>signerad av {name}</translation>
        </message>
        <message>
            <source>{count} orders</source>
            <translation>{count} beställningar</translation>
        </message>
        <message>
            <source>{count} pieces are nested in {name}.</source>
            <translation>{count} stycken är utlagda i {name}.</translation>
        </message>
        <message>
            <source>{day}, overdue</source>
            <translation>{day}, försenad</translation>
        </message>
        <message>
            <source>{name} (open here)</source>
            <translation>{name} (öppen här)</translation>
        </message>
        <message>
            <source>{name} has this personal number already.</source>
            <translation>{name} har redan detta personnummer.</translation>
        </message>
        <message>
            <source>{name}: saved and closed.</source>
            <translation>{name}: sparat och stängt.</translation>
        </message>
        <message>
            <source>{name}: somebody else changed the same foot or field while the record did not answer. Theirs counts; what was changed here is kept beside it: feet under “Versions…” on the patient's page, fields in the notes of the visit.</source>
            <translation>{name}: någon annan ändrade samma fot eller fält medan journalen inte svarade. Deras gäller; det som ändrades här finns kvar bredvid: fötter under ”Versioner…” på patientens sida, fält i besökets anteckningar.</translation>
        </message>
        <message>
            <source>{name}: what was not saved yet is now in the record.</source>
            <translation>{name}: det som inte var sparat än finns nu i journalen.</translation>
        </message>
        <message>
            <source>{number}, revision {revision}</source>
            <translation>{number}, revision {revision}</translation>
        </message>
        <message>
            <source>{order} is in the record, with its files.</source>
            <translation>{order} finns i journalen med sina filer.</translation>
        </message>
        <message>
            <source>{order} is in the record, with its files; it is due {day}.</source>
            <translation>{order} finns i journalen med sina filer; den väntas {day}.</translation>
        </message>
    </context>
</TS>

<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv">
    <context>
        <name>insole_studio</name>
        <message>
            <source> min</source>
            <translation> min</translation>
        </message>
        <message>
            <source> years after the last entry</source>
            <translation> år efter den sista posten</translation>
        </message>
        <message>
            <source>A backup is being made.</source>
            <translation>En säkerhetskopia görs just nu.</translation>
        </message>
        <message>
            <source>A folder on a share that all stations reach</source>
            <translation>En mapp på en delad plats som alla stationer når</translation>
        </message>
        <message>
            <source>A folder on another disk, or on a share</source>
            <translation>En mapp på en annan disk eller på en delad plats</translation>
        </message>
        <message>
            <source>Account</source>
            <translation>Konto</translation>
        </message>
        <message>
            <source>Account {name}</source>
            <translation>Kontot {name}</translation>
        </message>
        <message>
            <source>Accounts</source>
            <translation>Konton</translation>
        </message>
        <message>
            <source>Accounts are off: whoever can use this computer can use the record, and the computer's user is noted with every change.</source>
            <translation>Konton är avstängda: den som kan använda datorn kan använda journalen, och datorns användare noteras vid varje ändring.</translation>
        </message>
        <message>
            <source>Accounts…</source>
            <translation>Konton…</translation>
        </message>
        <message>
            <source>Add account</source>
            <translation>Lägg till konto</translation>
        </message>
        <message>
            <source>Add account…</source>
            <translation>Lägg till konto…</translation>
        </message>
        <message>
            <source>Administrator's account</source>
            <translation>Administratörens konto</translation>
        </message>
        <message>
            <source>All</source>
            <translation>Alla</translation>
        </message>
        <message>
            <source>All of 30 days, then one of each month</source>
            <translation>Alla i 30 dagar, sedan en för varje månad</translation>
        </message>
        <message>
            <source>All of 30 days, then one of each month for a year</source>
            <translation>Alla i 30 dagar, sedan en för varje månad i ett år</translation>
        </message>
        <message>
            <source>All that the record holds of the listed patient goes.</source>
            <translation>Allt som journalen innehåller om patienten i listan försvinner.</translation>
        </message>
        <message>
            <source>All that the record holds of the {count} listed patients goes.</source>
            <translation>Allt som journalen innehåller om de {count} patienterna i listan försvinner.</translation>
        </message>
        <message>
            <source>As it stands on the patient's page: P-…</source>
            <translation>Som den står på patientens sida: P-…</translation>
        </message>
        <message>
            <source>Asking the database…</source>
            <translation>Frågar databasen…</translation>
        </message>
        <message>
            <source>At</source>
            <translation>Vid</translation>
        </message>
        <message>
            <source>At least 12 characters, such as four words; capitals and signs are not asked for.</source>
            <translation>Minst 12 tecken, till exempel fyra ord; stora bokstäver och tecken krävs inte.</translation>
        </message>
        <message>
            <source>Audit log</source>
            <translation>Logg</translation>
        </message>
        <message>
            <source>Audit log…</source>
            <translation>Logg…</translation>
        </message>
        <message>
            <source>Back the record up now, or every day</source>
            <translation>Säkerhetskopiera journalen nu eller varje dag</translation>
        </message>
        <message>
            <source>Back up now</source>
            <translation>Säkerhetskopiera nu</translation>
        </message>
        <message>
            <source>Backup</source>
            <translation>Säkerhetskopia</translation>
        </message>
        <message>
            <source>Backup {number} is made: patients {patients}, {rows} and {files}, {new_mb:.1f} MB of them new. All that was written has been read again and is right.</source>
            <translation>Säkerhetskopia {number} är gjord: patienter {patients}, {rows} och {files}, varav {new_mb:.1f} MB nya. Allt som skrevs har lästs igen och är rätt.</translation>
        </message>
        <message>
            <source>Backups are encrypted. Choose a passphrase of four words or more, and keep it on paper where the backup is not: without it nobody can restore the record.</source>
            <translation>Säkerhetskopior krypteras. Välj en lösenfras på minst fyra ord och förvara den på papper där säkerhetskopian inte finns: utan den kan ingen återställa journalen.</translation>
        </message>
        <message>
            <source>Backups in the folder</source>
            <translation>Säkerhetskopior i mappen</translation>
        </message>
        <message>
            <source>Backup…</source>
            <translation>Säkerhetskopiera…</translation>
        </message>
        <message>
            <source>Both are persons of their own again.</source>
            <translation>Båda är egna personer igen.</translation>
        </message>
        <message>
            <source>C&amp;linic</source>
            <translation>K&amp;linik</translation>
        </message>
        <message>
            <source>Cancel backup</source>
            <translation>Avbryt säkerhetskopieringen</translation>
        </message>
        <message>
            <source>Cancel restoring</source>
            <translation>Avbryt återställningen</translation>
        </message>
        <message>
            <source>Change account</source>
            <translation>Ändra konto</translation>
        </message>
        <message>
            <source>Change my password</source>
            <translation>Byt mitt lösenord</translation>
        </message>
        <message>
            <source>Change my password…</source>
            <translation>Byt mitt lösenord…</translation>
        </message>
        <message>
            <source>Change password</source>
            <translation>Byt lösenord</translation>
        </message>
        <message>
            <source>Change…</source>
            <translation>Ändra…</translation>
        </message>
        <message>
            <source>Check the audit log, the signatures and all files</source>
            <translation>Kontrollera loggen, signaturerna och alla filer</translation>
        </message>
        <message>
            <source>Choose a backup in the list first.</source>
            <translation>Välj en säkerhetskopia i listan först.</translation>
        </message>
        <message>
            <source>Choose a folder and one of its backups first.</source>
            <translation>Välj först en mapp och en av dess säkerhetskopior.</translation>
        </message>
        <message>
            <source>Choose an account first.</source>
            <translation>Välj ett konto först.</translation>
        </message>
        <message>
            <source>Choose another password for the account that has signed in</source>
            <translation>Välj ett annat lösenord för det inloggade kontot</translation>
        </message>
        <message>
            <source>Choose in the list what is to be undone first.</source>
            <translation>Välj först i listan vad som ska ångras.</translation>
        </message>
        <message>
            <source>Choose the folder of the backups first.</source>
            <translation>Välj först mappen för säkerhetskopiorna.</translation>
        </message>
        <message>
            <source>Choose the reason first.</source>
            <translation>Välj orsaken först.</translation>
        </message>
        <message>
            <source>Choose two patients first.</source>
            <translation>Välj två patienter först.</translation>
        </message>
        <message>
            <source>Choose why</source>
            <translation>Välj varför</translation>
        </message>
        <message>
            <source>Database</source>
            <translation>Databas</translation>
        </message>
        <message>
            <source>Day of the backup</source>
            <translation>Dag för säkerhetskopian</translation>
        </message>
        <message>
            <source>Details</source>
            <translation>Detaljer</translation>
        </message>
        <message>
            <source>Disabled: nobody can sign in with it</source>
            <translation>Spärrat: ingen kan logga in med det</translation>
        </message>
        <message>
            <source>Empty: from PostgreSQL's own password file</source>
            <translation>Tomt: från PostgreSQL:s egen lösenordsfil</translation>
        </message>
        <message>
            <source>Erase a patient</source>
            <translation>Radera en patient</translation>
        </message>
        <message>
            <source>Erase a patient…</source>
            <translation>Radera en patient…</translation>
        </message>
        <message>
            <source>Erase all listed…</source>
            <translation>Radera alla i listan…</translation>
        </message>
        <message>
            <source>Erase one patient for good</source>
            <translation>Radera en patient för gott</translation>
        </message>
        <message>
            <source>Erase {count} patients for good</source>
            <translation>Radera {count} patienter för gott</translation>
        </message>
        <message>
            <source>Erase {pseudonym} for good</source>
            <translation>Radera {pseudonym} för gott</translation>
        </message>
        <message>
            <source>Erased are name, birth date, personal number, contact and all notes, and captures that no insole was made from.</source>
            <translation>Namn, födelsedatum, personnummer, kontaktuppgifter och alla anteckningar raderas, liksom avbildningar som inget inlägg gjordes av.</translation>
        </message>
        <message>
            <source>Erase…</source>
            <translation>Radera…</translation>
        </message>
        <message>
            <source>Every day</source>
            <translation>Varje dag</translation>
        </message>
        <message>
            <source>Every {day}</source>
            <translation>Varje {day}</translation>
        </message>
        <message>
            <source>Everybody</source>
            <translation>Alla</translation>
        </message>
        <message>
            <source>Everything about {pseudonym} has been erased.</source>
            <translation>Allt om {pseudonym} är raderat.</translation>
        </message>
        <message>
            <source>Everything is what was stored.</source>
            <translation>Allt är som det lagrades.</translation>
        </message>
        <message>
            <source>Everything that says who {pseudonym} is has been erased; the devices stay documented until {day}.</source>
            <translation>Allt som säger vem {pseudonym} är har raderats; hjälpmedlen förblir dokumenterade till {day}.</translation>
        </message>
        <message>
            <source>Files only</source>
            <translation>Endast filer</translation>
        </message>
        <message>
            <source>Filled in, as it is empty: {fields}.</source>
            <translation>Fylls i, eftersom det är tomt: {fields}.</translation>
        </message>
        <message>
            <source>First password</source>
            <translation>Första lösenord</translation>
        </message>
        <message>
            <source>Folder</source>
            <translation>Mapp</translation>
        </message>
        <message>
            <source>Folder of the backups</source>
            <translation>Mapp för säkerhetskopiorna</translation>
        </message>
        <message>
            <source>Folder of the large files</source>
            <translation>Mapp för de stora filerna</translation>
        </message>
        <message>
            <source>From</source>
            <translation>Från</translation>
        </message>
        <message>
            <source>From {other} to {kept}, whose name and fields stay, move: visits {visits}, orders {orders}, follow-ups {follow_ups}.</source>
            <translation>Från {other} till {kept}, vars namn och fält står kvar, flyttas: besök {visits}, beställningar {orders}, uppföljningar {follow_ups}.</translation>
        </message>
        <message>
            <source>Full name</source>
            <translation>Fullständigt namn</translation>
        </message>
        <message>
            <source>Give the pseudonym of the patient first.</source>
            <translation>Ange patientens pseudonym först.</translation>
        </message>
        <message>
            <source>Hide the window until somebody signs in; the open case stays</source>
            <translation>Dölj fönstret tills någon loggar in; det öppna fallet står kvar</translation>
        </message>
        <message>
            <source>Hour of the backup</source>
            <translation>Klockslag för säkerhetskopian</translation>
        </message>
        <message>
            <source>It holds: patients {patients}, visits {visits}, versions of prescriptions {versions}, orders {orders}, files {files} ({size_mb:.1f} MB). Made by Insole Studio {program}.</source>
            <translation>Den innehåller: patienter {patients}, besök {visits}, versioner av ordinationer {versions}, beställningar {orders}, filer {files} ({size_mb:.1f} MB). Gjord av Insole Studio {program}.</translation>
        </message>
        <message>
            <source>Join two entries that turned out to be one person; this can be undone</source>
            <translation>Slå ihop två poster som visade sig vara samma person; det kan ångras</translation>
        </message>
        <message>
            <source>Kept until</source>
            <translation>Bevaras till</translation>
        </message>
        <message>
            <source>Large files</source>
            <translation>Stora filer</translation>
        </message>
        <message>
            <source>Last backup</source>
            <translation>Senaste säkerhetskopia</translation>
        </message>
        <message>
            <source>Lock windows without input after</source>
            <translation>Lås fönster utan inmatning efter</translation>
        </message>
        <message>
            <source>Lock, or change user</source>
            <translation>Lås eller byt användare</translation>
        </message>
        <message>
            <source>Locked</source>
            <translation>Låst</translation>
        </message>
        <message>
            <source>Made</source>
            <translation>Gjord</translation>
        </message>
        <message>
            <source>Merge</source>
            <translation>Slå ihop</translation>
        </message>
        <message>
            <source>Merge duplicate patients</source>
            <translation>Slå ihop dubbletter</translation>
        </message>
        <message>
            <source>Merge duplicate patients…</source>
            <translation>Slå ihop dubbletter…</translation>
        </message>
        <message>
            <source>Merged before</source>
            <translation>Tidigare sammanslagna</translation>
        </message>
        <message>
            <source>Merged into it</source>
            <translation>Slås ihop med den</translation>
        </message>
        <message>
            <source>New account</source>
            <translation>Nytt konto</translation>
        </message>
        <message>
            <source>New password</source>
            <translation>Nytt lösenord</translation>
        </message>
        <message>
            <source>New password for {name}</source>
            <translation>Nytt lösenord för {name}</translation>
        </message>
        <message>
            <source>New password…</source>
            <translation>Nytt lösenord…</translation>
        </message>
        <message>
            <source>No backup was made: {reason}</source>
            <translation>Ingen säkerhetskopia gjordes: {reason}</translation>
        </message>
        <message>
            <source>No lines are shown yet.</source>
            <translation>Inga rader visas ännu.</translation>
        </message>
        <message>
            <source>Nobody seems to be in the record twice. Two persons are found by their names.</source>
            <translation>Ingen verkar finnas två gånger i journalen. Två personer hittas genom sina namn.</translation>
        </message>
        <message>
            <source>Nobody's time of keeping is over.</source>
            <translation>Ingens bevarandetid har gått ut.</translation>
        </message>
        <message>
            <source>Nobody: commands ask for the password</source>
            <translation>Ingen: kommandon frågar efter lösenordet</translation>
        </message>
        <message>
            <source>None yet</source>
            <translation>Ingen än</translation>
        </message>
        <message>
            <source>Nothing is moved: to take the present record along, make a backup of it, use the new place, and restore it there.</source>
            <translation>Inget flyttas: för att ta med den nuvarande journalen, säkerhetskopiera den, använd den nya platsen och återställ den där.</translation>
        </message>
        <message>
            <source>Nothing was written that fits.</source>
            <translation>Inget som passar har skrivits.</translation>
        </message>
        <message>
            <source>Old backups</source>
            <translation>Gamla kopior</translation>
        </message>
        <message>
            <source>Old backups removed: {count}.</source>
            <translation>Gamla kopior som togs bort: {count}.</translation>
        </message>
        <message>
            <source>Older lines</source>
            <translation>Äldre rader</translation>
        </message>
        <message>
            <source>On a PostgreSQL server that several stations share</source>
            <translation>På en PostgreSQL-server som flera stationer delar</translation>
        </message>
        <message>
            <source>On request, or after the time of keeping; what the law keeps stays</source>
            <translation>På begäran eller efter bevarandetiden; vad lagen bevarar står kvar</translation>
        </message>
        <message>
            <source>On this computer</source>
            <translation>På den här datorn</translation>
        </message>
        <message>
            <source>On this computer, or on a server that stations share</source>
            <translation>På den här datorn eller på en server som stationer delar</translation>
        </message>
        <message>
            <source>Only by hand</source>
            <translation>Endast för hand</translation>
        </message>
        <message>
            <source>Open the record again</source>
            <translation>Öppna journalen igen</translation>
        </message>
        <message>
            <source>Opened by</source>
            <translation>Öppnas med</translation>
        </message>
        <message>
            <source>Opening the backup…</source>
            <translation>Öppnar säkerhetskopian…</translation>
        </message>
        <message>
            <source>Passphrase</source>
            <translation>Lösenfras</translation>
        </message>
        <message>
            <source>Passphrase or private key</source>
            <translation>Lösenfras eller privat nyckel</translation>
        </message>
        <message>
            <source>Password</source>
            <translation>Lösenord</translation>
        </message>
        <message>
            <source>Patients erased: {count}.</source>
            <translation>Raderade patienter: {count}.</translation>
        </message>
        <message>
            <source>Present password</source>
            <translation>Nuvarande lösenord</translation>
        </message>
        <message>
            <source>Proposals</source>
            <translation>Förslag</translation>
        </message>
        <message>
            <source>Pseudonym: P-…</source>
            <translation>Pseudonym: P-…</translation>
        </message>
        <message>
            <source>Public key</source>
            <translation>Publik nyckel</translation>
        </message>
        <message>
            <source>Public key of age (age1…)</source>
            <translation>Publik nyckel för age (age1…)</translation>
        </message>
        <message>
            <source>Put the record back as a backup holds it</source>
            <translation>Lägg tillbaka journalen som en säkerhetskopia har den</translation>
        </message>
        <message>
            <source>Restore</source>
            <translation>Återställ</translation>
        </message>
        <message>
            <source>Restore from a backup</source>
            <translation>Återställ från en säkerhetskopia</translation>
        </message>
        <message>
            <source>Restore from a backup…</source>
            <translation>Återställ från en säkerhetskopia…</translation>
        </message>
        <message>
            <source>Restoring was stopped; the record is as it was.</source>
            <translation>Återställningen avbröts; journalen är som den var.</translation>
        </message>
        <message>
            <source>Role</source>
            <translation>Roll</translation>
        </message>
        <message>
            <source>Set password</source>
            <translation>Sätt lösenord</translation>
        </message>
        <message>
            <source>Set the present record aside and restore</source>
            <translation>Lägg undan den nuvarande journalen och återställ</translation>
        </message>
        <message>
            <source>Show</source>
            <translation>Visa</translation>
        </message>
        <message>
            <source>Show what is erased</source>
            <translation>Visa vad som raderas</translation>
        </message>
        <message>
            <source>Show what it holds</source>
            <translation>Visa innehållet</translation>
        </message>
        <message>
            <source>Show what the backup holds first.</source>
            <translation>Visa först vad säkerhetskopian innehåller.</translation>
        </message>
        <message>
            <source>Sign in</source>
            <translation>Logga in</translation>
        </message>
        <message>
            <source>Sign in to see the clinic's patients; files can be opened without.</source>
            <translation>Logga in för att se klinikens patienter; filer kan öppnas ändå.</translation>
        </message>
        <message>
            <source>Sign in…</source>
            <translation>Logga in…</translation>
        </message>
        <message>
            <source>Signing in…</source>
            <translation>Loggar in…</translation>
        </message>
        <message>
            <source>Subject</source>
            <translation>Gäller</translation>
        </message>
        <message>
            <source>Swap</source>
            <translation>Byt plats</translation>
        </message>
        <message>
            <source>Switch accounts off</source>
            <translation>Stäng av konton</translation>
        </message>
        <message>
            <source>Switch accounts on</source>
            <translation>Slå på konton</translation>
        </message>
        <message>
            <source>Switching them on makes the first administrator, who manages accounts and backups and does not see patients. Then add an account for everybody who treats patients, yourself included.</source>
            <translation>När de slås på skapas den första administratören, som sköter konton och säkerhetskopior och inte ser patienter. Lägg sedan till ett konto för alla som behandlar patienter, även för dig själv.</translation>
        </message>
        <message>
            <source>System user</source>
            <translation>Användare i systemet</translation>
        </message>
        <message>
            <source>Test the connection</source>
            <translation>Prova anslutningen</translation>
        </message>
        <message>
            <source>The backup was stopped; the ones before are as they were.</source>
            <translation>Säkerhetskopieringen avbröts; de tidigare är som de var.</translation>
        </message>
        <message>
            <source>The database answers and holds a record of an older Insole Studio, which would be brought up to date.</source>
            <translation>Databasen svarar och har en journal från ett äldre Insole Studio, som skulle uppdateras.</translation>
        </message>
        <message>
            <source>The database answers and holds a record; patients in it: {count}.</source>
            <translation>Databasen svarar och har en journal; patienter i den: {count}.</translation>
        </message>
        <message>
            <source>The database answers and is empty: a new record would begin there.</source>
            <translation>Databasen svarar och är tom: en ny journal skulle börja där.</translation>
        </message>
        <message>
            <source>The last backup is of {moment}; what was entered since is in no other place.</source>
            <translation>Den senaste säkerhetskopian är från {moment}; det som har förts in sedan dess finns ingen annanstans.</translation>
        </message>
        <message>
            <source>The law keeps what documents the devices, under the pseudonym, until {day} (Regulation (EU) 2017/745, Annex XIII).</source>
            <translation>Lagen bevarar det som dokumenterar hjälpmedlen, under pseudonymen, till {day} (förordning (EU) 2017/745, bilaga XIII).</translation>
        </message>
        <message>
            <source>The password is never stored: it is asked again at the next start, unless PostgreSQL's own password file has it.</source>
            <translation>Lösenordet lagras aldrig: det efterfrågas igen vid nästa start, om inte PostgreSQL:s egen lösenordsfil har det.</translation>
        </message>
        <message>
            <source>The password was changed.</source>
            <translation>Lösenordet är bytt.</translation>
        </message>
        <message>
            <source>The patient has asked for it</source>
            <translation>Patienten har bett om det</translation>
        </message>
        <message>
            <source>The record before cannot be read: who was erased after the backup may be in the list of patients again; erase them once more.</source>
            <translation>Den tidigare journalen kan inte läsas: den som raderades efter säkerhetskopian kan stå i patientlistan igen; radera en gång till.</translation>
        </message>
        <message>
            <source>The record before is kept as {path}.</source>
            <translation>Den tidigare journalen finns kvar som {path}.</translation>
        </message>
        <message>
            <source>The record is as it was on {moment}: {rows} and {files}.</source>
            <translation>Journalen är som den var {moment}: {rows} och {files}.</translation>
        </message>
        <message>
            <source>The record is being asked about its backups.</source>
            <translation>Journalen tillfrågas om sina säkerhetskopior.</translation>
        </message>
        <message>
            <source>The record is kept for</source>
            <translation>Journalen sparas i</translation>
        </message>
        <message>
            <source>The same</source>
            <translation>Detsamma</translation>
        </message>
        <message>
            <source>The same again</source>
            <translation>Samma igen</translation>
        </message>
        <message>
            <source>The time of keeping ended on {day}: all of it is erased.</source>
            <translation>Bevarandetiden slutade {day}: allt raderas.</translation>
        </message>
        <message>
            <source>The time of keeping is over</source>
            <translation>Bevarandetiden är slut</translation>
        </message>
        <message>
            <source>The time of keeping is over for these; nobody is erased by itself. Enter takes one:</source>
            <translation>Bevarandetiden har gått ut för dessa; ingen raderas av sig själv. Enter väljer en:</translation>
        </message>
        <message>
            <source>The window is locked</source>
            <translation>Fönstret är låst</translation>
        </message>
        <message>
            <source>There are no older lines.</source>
            <translation>Det finns inga äldre rader.</translation>
        </message>
        <message>
            <source>There is no backup yet: what is in the record is lost if its disk fails.</source>
            <translation>Det finns ingen säkerhetskopia än: det som finns i journalen går förlorat om dess disk går sönder.</translation>
        </message>
        <message>
            <source>These may be the same person. Two others are found by typing their names below.</source>
            <translation>De här kan vara samma person. Två andra hittas genom att skriva deras namn nedan.</translation>
        </message>
        <message>
            <source>This account is not locked.</source>
            <translation>Kontot är inte låst.</translation>
        </message>
        <message>
            <source>This can be undone under “Merged before”.</source>
            <translation>Det kan ångras under ”Tidigare sammanslagna”.</translation>
        </message>
        <message>
            <source>This cannot be undone; backups made before still hold the patient.</source>
            <translation>Det kan inte ångras; tidigare säkerhetskopior innehåller fortfarande patienten.</translation>
        </message>
        <message>
            <source>This is the same person twice; choose another one.</source>
            <translation>Det är samma person två gånger; välj en annan.</translation>
        </message>
        <message>
            <source>This one is merged into it</source>
            <translation>Den här slås ihop med den</translation>
        </message>
        <message>
            <source>This patient is kept</source>
            <translation>Den här patienten behålls</translation>
        </message>
        <message>
            <source>To</source>
            <translation>Till</translation>
        </message>
        <message>
            <source>Try again to open a record that could not be opened</source>
            <translation>Försök igen att öppna en journal som inte gick att öppna</translation>
        </message>
        <message>
            <source>Type the passphrase of the backup.</source>
            <translation>Skriv säkerhetskopians lösenfras.</translation>
        </message>
        <message>
            <source>Type the whole path of the folder, or choose it.</source>
            <translation>Skriv hela sökvägen till mappen eller välj den.</translation>
        </message>
        <message>
            <source>Undo this merge</source>
            <translation>Ångra sammanslagningen</translation>
        </message>
        <message>
            <source>Unlock</source>
            <translation>Lås upp</translation>
        </message>
        <message>
            <source>Until then, what can be read is shown after signing in.</source>
            <translation>Tills dess visas det som går att läsa efter inloggning.</translation>
        </message>
        <message>
            <source>Use this record</source>
            <translation>Använd den här journalen</translation>
        </message>
        <message>
            <source>User of the operating system who runs commands with this account, unasked</source>
            <translation>Användare i operativsystemet som kör kommandon med kontot utan att tillfrågas</translation>
        </message>
        <message>
            <source>Verify again</source>
            <translation>Kontrollera igen</translation>
        </message>
        <message>
            <source>Verify the log</source>
            <translation>Kontrollera loggen</translation>
        </message>
        <message>
            <source>Verify the record</source>
            <translation>Kontrollera journalen</translation>
        </message>
        <message>
            <source>Verify the record…</source>
            <translation>Kontrollera journalen…</translation>
        </message>
        <message>
            <source>Visits</source>
            <translation>Besök</translation>
        </message>
        <message>
            <source>Wait until the record is restored, or cancel that.</source>
            <translation>Vänta tills journalen är återställd, eller avbryt det.</translation>
        </message>
        <message>
            <source>When</source>
            <translation>När</translation>
        </message>
        <message>
            <source>Where the record is</source>
            <translation>Var journalen finns</translation>
        </message>
        <message>
            <source>Where the record is…</source>
            <translation>Var journalen finns…</translation>
        </message>
        <message>
            <source>Who may sign in, and what each of them may do</source>
            <translation>Vem som får logga in och vad var och en får göra</translation>
        </message>
        <message>
            <source>Who saw, changed and exported what</source>
            <translation>Vem som såg, ändrade och exporterade vad</translation>
        </message>
        <message>
            <source>Your own password</source>
            <translation>Ditt eget lösenord</translation>
        </message>
        <message>
            <source>captures</source>
            <translation>avbildningar</translation>
        </message>
        <message>
            <source>count</source>
            <translation>antal</translation>
        </message>
        <message>
            <source>damaged</source>
            <translation>skadade</translation>
        </message>
        <message>
            <source>digest</source>
            <translation>kontrollsumma</translation>
        </message>
        <message>
            <source>disabled</source>
            <translation>spärrat</translation>
        </message>
        <message>
            <source>failed attempts</source>
            <translation>misslyckade försök</translation>
        </message>
        <message>
            <source>fields</source>
            <translation>fält</translation>
        </message>
        <message>
            <source>files</source>
            <translation>filer</translation>
        </message>
        <message>
            <source>first password</source>
            <translation>första lösenordet</translation>
        </message>
        <message>
            <source>has a user of the system</source>
            <translation>har en systemanvändare</translation>
        </message>
        <message>
            <source>kept until</source>
            <translation>sparas till</translation>
        </message>
        <message>
            <source>last line</source>
            <translation>sista raden</translation>
        </message>
        <message>
            <source>merge</source>
            <translation>sammanslagning</translation>
        </message>
        <message>
            <source>never</source>
            <translation>aldrig</translation>
        </message>
        <message>
            <source>nothing</source>
            <translation>inget</translation>
        </message>
        <message>
            <source>on request</source>
            <translation>på begäran</translation>
        </message>
        <message>
            <source>orders</source>
            <translation>beställningar</translation>
        </message>
        <message>
            <source>password</source>
            <translation>lösenord</translation>
        </message>
        <message>
            <source>prescriptions</source>
            <translation>ordinationer</translation>
        </message>
        <message>
            <source>release</source>
            <translation>frisläppning</translation>
        </message>
        <message>
            <source>removed</source>
            <translation>borttagna</translation>
        </message>
        <message>
            <source>revision</source>
            <translation>revision</translation>
        </message>
        <message>
            <source>role</source>
            <translation>roll</translation>
        </message>
        <message>
            <source>rows</source>
            <translation>rader</translation>
        </message>
        <message>
            <source>sample patient</source>
            <translation>provpatient</translation>
        </message>
        <message>
            <source>side</source>
            <translation>sida</translation>
        </message>
        <message>
            <source>signed in by</source>
            <translation>inloggad med</translation>
        </message>
        <message>
            <source>state</source>
            <translation>läge</translation>
        </message>
        <message>
            <source>time of keeping over</source>
            <translation>gallringstiden slut</translation>
        </message>
        <message>
            <source>under a pseudonym</source>
            <translation>under pseudonym</translation>
        </message>
        <message>
            <source>user of the system</source>
            <translation>systemanvändare</translation>
        </message>
        <message>
            <source>visits</source>
            <translation>besök</translation>
        </message>
        <message>
            <source>wrong passwords: {count}</source>
            <translation>fel lösenord: {count}</translation>
        </message>
        <message>
            <source>years</source>
            <translation>år</translation>
        </message>
        <message>
            <source>years before</source>
            <translation>år dessförinnan</translation>
        </message>
        <message>
            <source>years of keeping</source>
            <translation>bevarandetid</translation>
        </message>
        <message>
            <source>{newest}; backups in the folder: {count}, the oldest of {oldest}</source>
            <translation>{newest}; kopior i mappen: {count}, den äldsta från {oldest}</translation>
        </message>
        <message>
            <source>{other} is now part of {kept}.</source>
            <translation>{other} är nu en del av {kept}.</translation>
        </message>
        <message>
            <source>{pseudonym}: visits {visits}, orders {orders}.</source>
            <translation>{pseudonym}: besök {visits}, beställningar {orders}.</translation>
        </message>
    </context>
</TS>

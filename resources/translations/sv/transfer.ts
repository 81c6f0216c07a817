<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv">
    <context>
        <name>insole_studio</name>
        <message>
            <source>Add the case files of a folder as visits</source>
            <translation>Lägg till fallfilerna i en mapp som besök</translation>
        </message>
        <message>
            <source>Add the doubtful ones, too, as new patients</source>
            <translation>Lägg även till de tveksamma, som nya patienter</translation>
        </message>
        <message>
            <source>Add the patients of a table (CSV) from another program</source>
            <translation>Lägg till patienterna i en tabell (CSV) från ett annat program</translation>
        </message>
        <message>
            <source>Add {count}</source>
            <translation>Lägg till {count}</translation>
        </message>
        <message>
            <source>Choose first which names are right.</source>
            <translation>Välj först vilka namn som är rätt.</translation>
        </message>
        <message>
            <source>Column {number}</source>
            <translation>Kolumn {number}</translation>
        </message>
        <message>
            <source>Dates such as 02/03/1970</source>
            <translation>Datum som 02/03/1970</translation>
        </message>
        <message>
            <source>Everything, for the patient or another clinic</source>
            <translation>Allt, till patienten eller en annan klinik</translation>
        </message>
        <message>
            <source>Export patient</source>
            <translation>Exportera patient</translation>
        </message>
        <message>
            <source>Export patient into</source>
            <translation>Exportera patienten till</translation>
        </message>
        <message>
            <source>Export patient…</source>
            <translation>Exportera patient…</translation>
        </message>
        <message>
            <source>Export the patient as a folder that opens without this program</source>
            <translation>Exportera patienten som en mapp som går att öppna utan detta program</translation>
        </message>
        <message>
            <source>Exported to {folder}.</source>
            <translation>Exporterat till {folder}.</translation>
        </message>
        <message>
            <source>Import case files</source>
            <translation>Importera fallfiler</translation>
        </message>
        <message>
            <source>Import case files…</source>
            <translation>Importera fallfiler…</translation>
        </message>
        <message>
            <source>Import patients from {name}</source>
            <translation>Importera patienter från {name}</translation>
        </message>
        <message>
            <source>Import patients…</source>
            <translation>Importera patienter…</translation>
        </message>
        <message>
            <source>Import: {counts}</source>
            <translation>Import: {counts}</translation>
        </message>
        <message>
            <source>Not exported:</source>
            <translation>Inte exporterat:</translation>
        </message>
        <message>
            <source>Open a patient first.</source>
            <translation>Öppna först en patient.</translation>
        </message>
        <message>
            <source>Personal numbers</source>
            <translation>Personnummer</translation>
        </message>
        <message>
            <source>Row</source>
            <translation>Rad</translation>
        </message>
        <message>
            <source>Table</source>
            <translation>Tabell</translation>
        </message>
        <message>
            <source>The file is being read.</source>
            <translation>Filen läses.</translation>
        </message>
        <message>
            <source>There is nobody to add.</source>
            <translation>Det finns ingen att lägga till.</translation>
        </message>
        <message>
            <source>There is nothing to report.</source>
            <translation>Det finns inget att rapportera.</translation>
        </message>
        <message>
            <source>Two that turn out to be one can be merged later.</source>
            <translation>Två som visar sig vara en och samma kan slås ihop senare.</translation>
        </message>
        <message>
            <source>What becomes of each row</source>
            <translation>Vad som händer med varje rad</translation>
        </message>
        <message>
            <source>What becomes of it</source>
            <translation>Vad som händer</translation>
        </message>
        <message>
            <source>Why</source>
            <translation>Varför</translation>
        </message>
        <message>
            <source>Without name, birth date, texts and scans, for a shop or for research</source>
            <translation>Utan namn, födelsedatum, texter och skanningar, till en verkstad eller för forskning</translation>
        </message>
        <message>
            <source>choose</source>
            <translation>välj</translation>
        </message>
        <message>
            <source>comma</source>
            <translation>komma</translation>
        </message>
        <message>
            <source>import report</source>
            <translation>importrapport</translation>
        </message>
        <message>
            <source>is added</source>
            <translation>läggs till</translation>
        </message>
        <message>
            <source>is doubtful</source>
            <translation>är tveksam</translation>
        </message>
        <message>
            <source>is refused</source>
            <translation>avvisas</translation>
        </message>
        <message>
            <source>not imported</source>
            <translation>importeras inte</translation>
        </message>
        <message>
            <source>semicolon</source>
            <translation>semikolon</translation>
        </message>
        <message>
            <source>tab</source>
            <translation>tabb</translation>
        </message>
        <message>
            <source>the day comes first</source>
            <translation>dagen kommer först</translation>
        </message>
        <message>
            <source>the month comes first</source>
            <translation>månaden kommer först</translation>
        </message>
        <message>
            <source>{name}: visits, prescriptions, insoles (STL), scans and orders as a folder that opens without this program.</source>
            <translation>{name}: besök, ordinationer, inlägg (STL), skanningar och beställningar som en mapp som går att öppna utan detta program.</translation>
        </message>
    </context>
</TS>

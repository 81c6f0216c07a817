<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>A over B</source>
            <translation>A över B</translation>
        </message>
        <message>
            <source>A − B {apart} mm: within the error</source>
            <translation>A − B {apart} mm: inom felet</translation>
        </message>
        <message>
            <source>As they lie</source>
            <translation>Som de ligger</translation>
        </message>
        <message>
            <source>B is laid on A by</source>
            <translation>B läggs på A med</translation>
        </message>
        <message>
            <source>Best fit</source>
            <translation>Bästa passning</translation>
        </message>
        <message>
            <source>Both surfaces are evened out over this width before they are compared; 1 for none</source>
            <translation>Båda ytorna jämnas ut över den här bredden innan de jämförs; 1 för ingen utjämning</translation>
        </message>
        <message>
            <source>Choose what is compared, at the left.</source>
            <translation>Välj till vänster vad som jämförs.</translation>
        </message>
        <message>
            <source>Choose…</source>
            <translation>Välj…</translation>
        </message>
        <message>
            <source>Click the same places on A and B, three or more. Picked: {a} on A, {b} on B.</source>
            <translation>Klicka på samma ställen på A och B, tre eller fler. Utpekade: {a} på A, {b} på B.</translation>
        </message>
        <message>
            <source>Compare surfaces</source>
            <translation>Jämför ytor</translation>
        </message>
        <message>
            <source>Compare surfaces…</source>
            <translation>Jämför ytor…</translation>
        </message>
        <message>
            <source>Compared area</source>
            <translation>Jämförd yta</translation>
        </message>
        <message>
            <source>Difference in 3-D</source>
            <translation>Skillnad i 3-D</translation>
        </message>
        <message>
            <source>Difference maps</source>
            <translation>Skillnadskartor</translation>
        </message>
        <message>
            <source>Drawing the difference</source>
            <translation>Ritar skillnaden</translation>
        </message>
        <message>
            <source>Feet (mm)</source>
            <translation>Fötter (mm)</translation>
        </message>
        <message>
            <source>First, A</source>
            <translation>Första, A</translation>
        </message>
        <message>
            <source>Forefoot width</source>
            <translation>Framfotsbredd</translation>
        </message>
        <message>
            <source>Four black dots</source>
            <translation>Fyra svarta prickar</translation>
        </message>
        <message>
            <source>How far feet, insoles and scans of moulds differ</source>
            <translation>Hur mycket fötter, inlägg och skanningar av formar skiljer sig</translation>
        </message>
        <message>
            <source>Largest</source>
            <translation>Störst</translation>
        </message>
        <message>
            <source>Mean</source>
            <translation>Medel</translation>
        </message>
        <message>
            <source>Mean, signed</source>
            <translation>Medel, med tecken</translation>
        </message>
        <message>
            <source>Mesh or archive</source>
            <translation>Ytmodell eller arkiv</translation>
        </message>
        <message>
            <source>Mesh or archive…</source>
            <translation>Ytmodell eller arkiv…</translation>
        </message>
        <message>
            <source>Picked points</source>
            <translation>Utpekade punkter</translation>
        </message>
        <message>
            <source>Residual of the fit</source>
            <translation>Passningens restfel</translation>
        </message>
        <message>
            <source>Save report…</source>
            <translation>Spara rapport…</translation>
        </message>
        <message>
            <source>Second, B</source>
            <translation>Andra, B</translation>
        </message>
        <message>
            <source>Session, also of a mould…</source>
            <translation>Session, även av en form…</translation>
        </message>
        <message>
            <source>Smoothing</source>
            <translation>Utjämning</translation>
        </message>
        <message>
            <source>Something unexpected happened; nothing was changed. Please report it.</source>
            <translation>Något oväntat hände; inget ändrades. Anmäl det gärna.</translation>
        </message>
        <message>
            <source>Surfaces</source>
            <translation>Ytor</translation>
        </message>
        <message>
            <source>Take the last point back</source>
            <translation>Ta tillbaka senaste punkten</translation>
        </message>
        <message>
            <source>Writing the report</source>
            <translation>Skriver rapporten</translation>
        </message>
    </context>
</TS>

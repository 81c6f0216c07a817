<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE">
    <context>
        <name>insole_studio</name>
        <message>
            <source>&amp;Feet</source>
            <translation>&amp;Fötter</translation>
        </message>
        <message>
            <source>Add the left foot</source>
            <translation>Lägg till vänster fot</translation>
        </message>
        <message>
            <source>Add the left foot to the case</source>
            <translation>Lägg till vänster fot i fallet</translation>
        </message>
        <message>
            <source>Add the right foot</source>
            <translation>Lägg till höger fot</translation>
        </message>
        <message>
            <source>Add the right foot to the case</source>
            <translation>Lägg till höger fot i fallet</translation>
        </message>
        <message>
            <source>Begin a new case</source>
            <translation>Börja ett nytt fall</translation>
        </message>
        <message>
            <source>Both feet side by side</source>
            <translation>Båda fötterna sida vid sida</translation>
        </message>
        <message>
            <source>Call the chosen variant by another name</source>
            <translation>Ge den valda varianten ett annat namn</translation>
        </message>
        <message>
            <source>Choose the variant after this one</source>
            <translation>Välj varianten efter denna</translation>
        </message>
        <message>
            <source>Choose variant {name}</source>
            <translation>Välj variant {name}</translation>
        </message>
        <message>
            <source>Colour by the difference to what stands beside, mirrored where it has to be</source>
            <translation>Färga efter skillnaden mot det som står bredvid, speglat där det behövs</translation>
        </message>
        <message>
            <source>Copy the prescription to the left foot</source>
            <translation>Kopiera ordinationen till vänster fot</translation>
        </message>
        <message>
            <source>Copy the prescription to the other foot</source>
            <translation>Kopiera ordinationen till andra foten</translation>
        </message>
        <message>
            <source>Copy the prescription to the right foot</source>
            <translation>Kopiera ordinationen till höger fot</translation>
        </message>
        <message>
            <source>Copy the selected correction to the other foot</source>
            <translation>Kopiera vald korrigering till andra foten</translation>
        </message>
        <message>
            <source>Copy to the left foot: {name}</source>
            <translation>Kopiera till vänster fot: {name}</translation>
        </message>
        <message>
            <source>Copy to the right foot: {name}</source>
            <translation>Kopiera till höger fot: {name}</translation>
        </message>
        <message>
            <source>Delete the variant</source>
            <translation>Ta bort varianten</translation>
        </message>
        <message>
            <source>Delete variant {name}</source>
            <translation>Ta bort variant {name}</translation>
        </message>
        <message>
            <source>Difference map</source>
            <translation>Skillnadskarta</translation>
        </message>
        <message>
            <source>Dismiss</source>
            <translation>Stäng</translation>
        </message>
        <message>
            <source>Duplicate as a variant</source>
            <translation>Duplicera som variant</translation>
        </message>
        <message>
            <source>Duplicate as variant {name}</source>
            <translation>Duplicera som variant {name}</translation>
        </message>
        <message>
            <source>Go on with a copy of this prescription; the first stays</source>
            <translation>Fortsätt med en kopia av ordinationen; den första finns kvar</translation>
        </message>
        <message>
            <source>Keep the present one</source>
            <translation>Behåll den nuvarande</translation>
        </message>
        <message>
            <source>L − R</source>
            <translation>V − H</translation>
        </message>
        <message>
            <source>Leave the chosen variant out; undo brings it back</source>
            <translation>Ta bort den valda varianten; ångra hämtar den tillbaka</translation>
        </message>
        <message>
            <source>Left minus right</source>
            <translation>Vänster minus höger</translation>
        </message>
        <message>
            <source>Name the variant</source>
            <translation>Namnge varianten</translation>
        </message>
        <message>
            <source>Name the variant {name}</source>
            <translation>Namnge varianten {name}</translation>
        </message>
        <message>
            <source>Name the variant…</source>
            <translation>Namnge varianten…</translation>
        </message>
        <message>
            <source>Next variant</source>
            <translation>Nästa variant</translation>
        </message>
        <message>
            <source>No correction is selected; click on one in the list first.</source>
            <translation>Ingen korrigering är vald; klicka först på en i listan.</translation>
        </message>
        <message>
            <source>No earlier design of this patient is known; open the earlier case once.</source>
            <translation>Ingen tidigare design för patienten är känd; öppna det tidigare fallet en gång.</translation>
        </message>
        <message>
            <source>Nothing lies over each other</source>
            <translation>Inget ligger över vartannat</translation>
        </message>
        <message>
            <source>Notices</source>
            <translation>Meddelanden</translation>
        </message>
        <message>
            <source>One insole alone</source>
            <translation>Ett inlägg ensamt</translation>
        </message>
        <message>
            <source>One step of undo brings them back.</source>
            <translation>Ett steg Ångra hämtar tillbaka dem.</translation>
        </message>
        <message>
            <source>Prescribe it for the other foot as well, mirrored</source>
            <translation>Ordinera den även för andra foten, speglad</translation>
        </message>
        <message>
            <source>Prescribe it here, mirrored</source>
            <translation>Ordinera den här, speglad</translation>
        </message>
        <message>
            <source>Prescribe the same for the other foot, mirrored and fitted by its landmarks</source>
            <translation>Ordinera samma för andra foten, speglat och anpassat efter dess landmärken</translation>
        </message>
        <message>
            <source>Prescribe what was prescribed for this foot before</source>
            <translation>Ordinera det som ordinerats för denna fot tidigare</translation>
        </message>
        <message>
            <source>Prescribed for this foot before: {names}.</source>
            <translation>Ordinerat för denna fot tidigare: {names}.</translation>
        </message>
        <message>
            <source>Prescribed for this foot on {day}: {names}.</source>
            <translation>Ordinerat för denna fot {day}: {names}.</translation>
        </message>
        <message>
            <source>Put a new scan into the place of the old</source>
            <translation>Ersätt skanningen med en ny</translation>
        </message>
        <message>
            <source>Put in its place</source>
            <translation>Ersätt skanningen</translation>
        </message>
        <message>
            <source>Repeat the last design</source>
            <translation>Upprepa den senaste designen</translation>
        </message>
        <message>
            <source>Replace the prescription</source>
            <translation>Ersätt ordinationen</translation>
        </message>
        <message>
            <source>Show both feet, and both insoles, beside each other</source>
            <translation>Visa båda fötterna och båda inläggen bredvid varandra</translation>
        </message>
        <message>
            <source>Show nothing beside the foot at hand</source>
            <translation>Visa inget bredvid den aktuella foten</translation>
        </message>
        <message>
            <source>Show the variant that was chosen before beside the chosen one</source>
            <translation>Visa den tidigare valda varianten bredvid den valda</translation>
        </message>
        <message>
            <source>Stands in every correction from now on.</source>
            <translation>Står i varje korrigering från och med nu.</translation>
        </message>
        <message>
            <source>Take it as a left foot</source>
            <translation>Ta den som en vänster fot</translation>
        </message>
        <message>
            <source>Take it as a right foot</source>
            <translation>Ta den som en höger fot</translation>
        </message>
        <message>
            <source>The case has a left foot already.</source>
            <translation>Fallet har redan en vänster fot.</translation>
        </message>
        <message>
            <source>The case has a right foot already.</source>
            <translation>Fallet har redan en höger fot.</translation>
        </message>
        <message>
            <source>The case has no left foot yet; open its scan, and it is added.</source>
            <translation>Fallet har ingen vänster fot ännu; öppna dess skanning så läggs den till.</translation>
        </message>
        <message>
            <source>The case has no right foot yet; open its scan, and it is added.</source>
            <translation>Fallet har ingen höger fot ännu; öppna dess skanning så läggs den till.</translation>
        </message>
        <message>
            <source>The case has one foot only; open the scan of the other, and it is added.</source>
            <translation>Fallet har bara en fot; öppna den andras skanning så läggs den till.</translation>
        </message>
        <message>
            <source>The case was exported as order {number}.</source>
            <translation>Fallet exporterades som beställning {number}.</translation>
        </message>
        <message>
            <source>The difference in per cent of the mean of both</source>
            <translation>Skillnaden i procent av bådas medelvärde</translation>
        </message>
        <message>
            <source>The left foot has a prescription.</source>
            <translation>Vänster fot har en ordination.</translation>
        </message>
        <message>
            <source>The name that stands in every correction</source>
            <translation>Namnet som står i varje korrigering</translation>
        </message>
        <message>
            <source>The new prescription has no {names}; the left foot loses that.</source>
            <translation>Den nya ordinationen har inte {names}; vänster fot förlorar det.</translation>
        </message>
        <message>
            <source>The new prescription has no {names}; the right foot loses that.</source>
            <translation>Den nya ordinationen har inte {names}; höger fot förlorar det.</translation>
        </message>
        <message>
            <source>The other foot</source>
            <translation>Andra foten</translation>
        </message>
        <message>
            <source>The right foot has a prescription.</source>
            <translation>Höger fot har en ordination.</translation>
        </message>
        <message>
            <source>The template was made for a left foot; it is mirrored for this right one.</source>
            <translation>Mallen gjordes för en vänster fot; den speglas för denna högra.</translation>
        </message>
        <message>
            <source>The template was made for a right foot; it is mirrored for this left one.</source>
            <translation>Mallen gjordes för en höger fot; den speglas för denna vänstra.</translation>
        </message>
        <message>
            <source>The variant that is shown, checked and made</source>
            <translation>Varianten som visas, kontrolleras och tillverkas</translation>
        </message>
        <message>
            <source>This foot has one variant only; duplicate it first (Ctrl+D).</source>
            <translation>Foten har bara en variant; duplicera den först (Ctrl+D).</translation>
        </message>
        <message>
            <source>Two variants side by side</source>
            <translation>Två varianter sida vid sida</translation>
        </message>
        <message>
            <source>Variant</source>
            <translation>Variant</translation>
        </message>
        <message>
            <source>Variant {name}</source>
            <translation>Variant {name}</translation>
        </message>
        <message>
            <source>What is variant {name} to be called?</source>
            <translation>Vad ska variant {name} heta?</translation>
        </message>
        <message>
            <source>Who prescribes?</source>
            <translation>Vem ordinerar?</translation>
        </message>
        <message>
            <source>Who prescribes…</source>
            <translation>Vem ordinerar…</translation>
        </message>
        <message>
            <source>With the new scan in its place, the design can be repeated in one click.</source>
            <translation>Med den nya skanningen kan designen upprepas med ett klick.</translation>
        </message>
        <message>
            <source>Work on the left foot</source>
            <translation>Arbeta med vänster fot</translation>
        </message>
        <message>
            <source>Work on the other foot of the case</source>
            <translation>Arbeta med fallets andra fot</translation>
        </message>
        <message>
            <source>Work on the right foot</source>
            <translation>Arbeta med höger fot</translation>
        </message>
        <message>
            <source>mean {mean:+.2f}   95 % {p95:.2f}   max {max:.2f} mm</source>
            <translation>medel {mean:+.2f}   95 % {p95:.2f}   max {max:.2f} mm</translation>
        </message>
        <message>
            <source>{this} − {other} mirrored</source>
            <translation>{this} − {other} speglad</translation>
        </message>
    </context>
</TS>

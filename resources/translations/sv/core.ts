<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source> of corrections[{number}] ({type})</source>
            <translation> i corrections[{number}] ({type})</translation>
        </message>
        <message>
            <source> of layers</source>
            <translation> i layers</translation>
        </message>
        <message>
            <source> of outline</source>
            <translation> i outline</translation>
        </message>
        <message>
            <source> of posts[{number}]</source>
            <translation> i posts[{number}]</translation>
        </message>
        <message>
            <source> of rim[{number}]</source>
            <translation> i rim[{number}]</translation>
        </message>
        <message>
            <source>"{serial}" is no serial number of a sensor; give its letters and digits as they stand on its label.</source>
            <translation>”{serial}” är inget serienummer för en sensor; ange dess bokstäver och siffror som de står på etiketten.</translation>
        </message>
        <message>
            <source>"{start}…" has {count} characters, and the papers take at most {most}; shorten it.</source>
            <translation>”{start}…” har {count} tecken, och papperen rymmer högst {most}; förkorta texten.</translation>
        </message>
        <message>
            <source>"{text}" is no size of a shoe from {least:g} to {greatest:g}; the outline stays as it is.</source>
            <translation>"{text}" är ingen skostorlek från {least:g} till {greatest:g}; konturen förblir som den är.</translation>
        </message>
        <message>
            <source>"{text}" names no view and sensor; write for example left=A00362A.</source>
            <translation>”{text}” anger ingen vy och sensor; skriv till exempel left=A00362A.</translation>
        </message>
        <message>
            <source>"{view}" cannot name a view; use 1 to 32 of the letters a-z, 0-9 and _.</source>
            <translation>”{view}” kan inte vara namnet på en vy; använd 1 till 32 av tecknen a-z, 0-9 och _.</translation>
        </message>
        <message>
            <source>"{words}" is no shoe size; write system and size, such as "EU 42".</source>
            <translation>”{words}” är ingen skostorlek; skriv system och storlek, till exempel ”EU 42”.</translation>
        </message>
        <message>
            <source>.</source>
            <translation>,</translation>
        </message>
        <message>
            <source>0 % behind the heel, 70 % beside the metatarsal head, 100 % at the toes</source>
            <translation>0 % bakom hälen, 70 % vid metatarsalhuvudet, 100 % vid tårna</translation>
        </message>
        <message>
            <source>0°</source>
            <translation>0°</translation>
        </message>
        <message>
            <source>1 capture, which may show or name the patient</source>
            <translation>1 inspelning, som kan visa eller nämna patienten</translation>
        </message>
        <message>
            <source>1 entry</source>
            <translation>1 post</translation>
        </message>
        <message>
            <source>1 file</source>
            <translation>1 fil</translation>
        </message>
        <message>
            <source>1 job sheet</source>
            <translation>1 arbetsblad</translation>
        </message>
        <message>
            <source>1 line</source>
            <translation>1 rad</translation>
        </message>
        <message>
            <source>1 photo, which shows the patient</source>
            <translation>1 foto, som visar patienten</translation>
        </message>
        <message>
            <source>1 row</source>
            <translation>1 rad</translation>
        </message>
        <message>
            <source>1 signature</source>
            <translation>1 signatur</translation>
        </message>
        <message>
            <source>100 % smooths out all that a stroke can</source>
            <translation>100 % jämnar ut allt som ett drag kan</translation>
        </message>
        <message>
            <source>1st head</source>
            <translation>1:a huvudet</translation>
        </message>
        <message>
            <source>1st toe</source>
            <translation>stortån</translation>
        </message>
        <message>
            <source>1st-ray cut-out</source>
            <translation>urtag första strålen</translation>
        </message>
        <message>
            <source>2nd head</source>
            <translation>2:a huvudet</translation>
        </message>
        <message>
            <source>2nd toe</source>
            <translation>2:a tån</translation>
        </message>
        <message>
            <source>5th head</source>
            <translation>5:e huvudet</translation>
        </message>
        <message>
            <source>5th-ray cut-out</source>
            <translation>urtag femte strålen</translation>
        </message>
        <message>
            <source>95 % are below</source>
            <translation>95 % ligger under</translation>
        </message>
        <message>
            <source>&gt; 0 raises the medial edge (varus), &lt; 0 the lateral one (valgus)</source>
            <translation>&gt; 0 höjer den mediala kanten (varus), &lt; 0 den laterala (valgus)</translation>
        </message>
        <message>
            <source>&gt; 0 raises the medial edge of the forefoot (varus), &lt; 0 the lateral one</source>
            <translation>&gt; 0 höjer framfotens mediala kant (varus), &lt; 0 den laterala</translation>
        </message>
        <message>
            <source>&gt; 0 raises the medial edge of the rearfoot (varus), &lt; 0 the lateral one</source>
            <translation>&gt; 0 höjer bakfotens mediala kant (varus), &lt; 0 den laterala</translation>
        </message>
        <message>
            <source>A ChArUco marker of {marker_mm:g} mm does not fit a square of {square_mm:g} mm; give the marker's own size in mm.</source>
            <translation>En ChArUco-markör på {marker_mm:g} mm ryms inte i en ruta på {square_mm:g} mm; ange markörens egen storlek i mm.</translation>
        </message>
        <message>
            <source>A block needs a name; type one.</source>
            <translation>Ett block behöver ett namn; skriv ett.</translation>
        </message>
        <message>
            <source>A board of {columns}×{rows} is too small; it must have at least {least}×{least}.</source>
            <translation>Ett bräde med {columns}×{rows} är för litet; det måste ha minst {least}×{least}.</translation>
        </message>
        <message>
            <source>A body of known form takes the place of one foot; choose the side left or right.</source>
            <translation>En kropp med känd form tar platsen för en fot; välj sidan vänster eller höger.</translation>
        </message>
        <message>
            <source>A body of {diameter_mm:g} mm cannot be simulated in the place of a foot; choose a diameter from {low:g} to {high:g} mm.</source>
            <translation>En kropp på {diameter_mm:g} mm kan inte simuleras på en fots plats; välj en diameter från {low:g} till {high:g} mm.</translation>
        </message>
        <message>
            <source>A body weight of {weight_kg:g} kg cannot be right: it must be {range}; put in the patient's weight.</source>
            <translation>En kroppsvikt på {weight_kg:g} kg kan inte stämma: den måste vara {range}; ange patientens vikt.</translation>
        </message>
        <message>
            <source>A bulge that all walls share is taken for distortion; if they were one wall, check it with a straightedge.</source>
            <translation>En buktning som alla väggar delar tas för förvrängning; om de var en och samma vägg, kontrollera den med en riktskiva.</translation>
        </message>
        <message>
            <source>A cast taken under weight shows tissue that is spread already: no expansion is proposed.</source>
            <translation>En avgjutning som tagits under belastning visar vävnad som redan är utbredd: inget mjukdelstillägg föreslås.</translation>
        </message>
        <message>
            <source>A chamfer of {chamfer_mm:g} mm is more than half of the thickness; where the insole is {thickness_mm:g} mm thick, only {half_mm:g} mm of its edge are bevelled. Make the chamfer smaller.</source>
            <translation>En fas på {chamfer_mm:g} mm är mer än halva tjockleken; där inlägget är {thickness_mm:g} mm tjockt fasas bara {half_mm:g} mm av kanten. Gör fasen mindre.</translation>
        </message>
        <message>
            <source>A colour image of {width} x {height} px cannot be simulated; choose 1280 x 1024, 1280 x 960 or 640 x 480.</source>
            <translation>En färgbild på {width} x {height} px kan inte simuleras; välj 1280 x 1024, 1280 x 960 eller 640 x 480.</translation>
        </message>
        <message>
            <source>A cover that is glued on later is taken off what is made</source>
            <translation>Ett överdrag som limmas på senare dras av från det som tillverkas</translation>
        </message>
        <message>
            <source>A cutter of {diameter_mm:g} mm is asked for, and must be {least_mm:g} to {most_mm:g} mm; give another diameter.</source>
            <translation>En fräs på {diameter_mm:g} mm begärs, och måste vara {least_mm:g} till {most_mm:g} mm; ange en annan diameter.</translation>
        </message>
        <message>
            <source>A design does not say what its separate layers are made of; they are taken for the material of the rest, and the limits allow for half and twice its stiffness.</source>
            <translation>En design anger inte vad dess separata skikt är gjorda av; de räknas som materialet i resten, och gränserna rymmer halva och dubbla styvheten.</translation>
        </message>
        <message>
            <source>A design names no material; foam of Shore A {hardness:g} is assumed, and the limits allow for half and twice its stiffness.</source>
            <translation>En design anger inget material; skum med Shore A {hardness:g} antas, och gränserna rymmer halva och dubbla styvheten.</translation>
        </message>
        <message>
            <source>A distance of {distance_mm:g} mm between the two points is asked for; give one of {least:.0f} to {most:.0f} mm.</source>
            <translation>Ett avstånd på {distance_mm:g} mm mellan de två punkterna begärs; ange ett på {least:.0f} till {most:.0f} mm.</translation>
        </message>
        <message>
            <source>A dome or a bar; trials disagree where a dome works best.</source>
            <translation>En pelott eller en stav; studier är oense om var en pelott verkar bäst.</translation>
        </message>
        <message>
            <source>A dowel hole of {hole:g} mm cannot be bored with the cutter "{cutter}"; choose a thicker dowel.</source>
            <translation>Ett styrpinnshål på {hole:g} mm kan inte borras med fräsen ”{cutter}”; välj en tjockare styrpinne.</translation>
        </message>
        <message>
            <source>A drawing of {width_mm:.0f}×{height_mm:.0f} mm does not fit a page of {page_width_mm:.0f}×{page_height_mm:.0f} mm; choose a larger page, or make the drawing smaller.</source>
            <translation>En ritning på {width_mm:.0f}×{height_mm:.0f} mm får inte plats på en sida på {page_width_mm:.0f}×{page_height_mm:.0f} mm; välj ett större papper, eller gör ritningen mindre.</translation>
        </message>
        <message>
            <source>A flat sheet of {area_cm2:.0f} cm² (floor, table or glass) was cut off.</source>
            <translation>En plan yta på {area_cm2:.0f} cm² (golv, bord eller glas) har skurits bort.</translation>
        </message>
        <message>
            <source>A foot of {length_mm:.0f} mm is asked for, but feet are {least:.0f} to {most:.0f} mm long; correct the length or the shoe size.</source>
            <translation>En fot på {length_mm:.0f} mm begärs, men fötter är {least:.0f} till {most:.0f} mm långa; rätta längden eller skostorleken.</translation>
        </message>
        <message>
            <source>A length of the printed bar is not above 0; measure it again.</source>
            <translation>En längd på den utskrivna staven är inte större än 0; mät den igen.</translation>
        </message>
        <message>
            <source>A line on a photo has at most {most} points; draw it in parts.</source>
            <translation>En linje på ett foto har högst {most} punkter; rita den i delar.</translation>
        </message>
        <message>
            <source>A mark must lie on the photo; draw it again.</source>
            <translation>Ett märke måste ligga på fotot; rita det igen.</translation>
        </message>
        <message>
            <source>A material needs a name; type one.</source>
            <translation>Ett material behöver ett namn; skriv ett.</translation>
        </message>
        <message>
            <source>A name must have 1 to {most} characters, and a letter or a digit among them; type another one.</source>
            <translation>Ett namn måste ha 1 till {most} tecken, varav minst en bokstav eller siffra; skriv ett annat.</translation>
        </message>
        <message>
            <source>A newer Insole Studio has changed {place} meanwhile; install the newest version on this computer, too.</source>
            <translation>Ett nyare Insole Studio har under tiden ändrat {place}; installera den nyaste versionen även på den här datorn.</translation>
        </message>
        <message>
            <source>A photo takes at most {most} marks; add another photo.</source>
            <translation>Ett foto tar högst {most} märken; lägg till ett foto till.</translation>
        </message>
        <message>
            <source>A piece of {area_cm2:.0f} cm² was left out: {kind}.</source>
            <translation>En del på {area_cm2:.0f} cm² har utelämnats: {kind}.</translation>
        </message>
        <message>
            <source>A plane</source>
            <translation>En plan yta</translation>
        </message>
        <message>
            <source>A plate of even thickness, to be built up by corrections</source>
            <translation>En platta av jämn tjocklek, som byggs upp med korrigeringar</translation>
        </message>
        <message>
            <source>A point is marked outside of the depth image of {width}×{height}; correct its pixel.</source>
            <translation>En punkt är märkt utanför djupbilden på {width}×{height}; rätta dess bildpunkt.</translation>
        </message>
        <message>
            <source>A posting only changes how the sole meets the insole here: no joint turns in the model.</source>
            <translation>En kilning ändrar här bara hur sulan möter inlägget: ingen led vrids i modellen.</translation>
        </message>
        <message>
            <source>A recipient of backups is named by its public key of age; give it as age1… .</source>
            <translation>En mottagare av säkerhetskopior anges med sin öppna age-nyckel; ange den som age1… .</translation>
        </message>
        <message>
            <source>A relief under each head that carries too much; no hard edges.</source>
            <translation>En avlastning under varje huvud som bär för mycket; inga hårda kanter.</translation>
        </message>
        <message>
            <source>A repeat test takes {least} to {most} captures of the same foot, each taken after the foot was taken off and put back; {count} are named.</source>
            <translation>Ett upprepningsprov behöver {least} till {most} avbildningar av samma fot, där foten tagits bort och lagts tillbaka före varje; {count} har angetts.</translation>
        </message>
        <message>
            <source>A router mills the insole from a block, and none is chosen; choose the block.</source>
            <translation>En fräsmaskin fräser inlägget ur ett block, och inget är valt; välj blocket.</translation>
        </message>
        <message>
            <source>A sensor was calibrated between {first} and {other}; capture them anew with one calibration.</source>
            <translation>En sensor kalibrerades mellan {first} och {other}; avbilda dem på nytt med en och samma kalibrering.</translation>
        </message>
        <message>
            <source>A shared record needs the folder of its large files, on a share that all stations reach; choose it.</source>
            <translation>En delad journal behöver mappen för sina stora filer, på en delad plats som alla stationer når; välj den.</translation>
        </message>
        <message>
            <source>A shift along the rows that is the same on all of the wall cannot be seen.</source>
            <translation>En förskjutning längs raderna som är lika på hela väggen syns inte.</translation>
        </message>
        <message>
            <source>A shift fits one distance; calibrate depth to colour to be right at all.</source>
            <translation>En förskjutning stämmer på ett avstånd; kalibrera djup mot färg för att det ska stämma på alla.</translation>
        </message>
        <message>
            <source>A shoe is {least:g} to {most:g} mm wide inside at the ball, and not {width:g} mm; put in the width in millimetres.</source>
            <translation>En sko är {least:g} till {most:g} mm bred invändigt vid trampdynan, och inte {width:g} mm; ange bredden i millimeter.</translation>
        </message>
        <message>
            <source>A side of {block} is longer than the {most:g} mm that a nest takes; take a smaller block.</source>
            <translation>En sida av {block} är längre än de {most:g} mm som en samläggning tar; ta ett mindre block.</translation>
        </message>
        <message>
            <source>A skive of {depth_mm:g} mm with {angle:g}° of inversion needs a heel cup of {needed_mm:g} mm, and the cup is {cup_mm:g} mm deep.</source>
            <translation>En hälskivning på {depth_mm:g} mm med {angle:g}° inversion kräver en hälskål på {needed_mm:g} mm, och skålen är {cup_mm:g} mm djup.</translation>
        </message>
        <message>
            <source>A sole stands out of a plane: it is a foot scanned with what lay around it, or a foam box whose file is inside out; say which it is.</source>
            <translation>En fotsula står ut ur ett plan: det är en fot som skannats med det som låg runt den, eller en skumlåda vars fil är ut och in; ange vilket det är.</translation>
        </message>
        <message>
            <source>A square of {square_mm:g} mm cannot be; measure its side and give it in millimetres ({low_mm:g} to {high_mm:g}).</source>
            <translation>En ruta på {square_mm:g} mm är inte möjlig; mät dess sida och ange den i millimeter ({low_mm:g} till {high_mm:g}).</translation>
        </message>
        <message>
            <source>A stereo camera always has a matching window, and colour images of 1920 x 1080; leave out what asks for others.</source>
            <translation>En stereokamera har alltid ett matchningsfönster, och färgbilder på 1920 x 1080; utelämna det som begär något annat.</translation>
        </message>
        <message>
            <source>A stiff shell; the arch lower than usual.</source>
            <translation>Ett styvt skal; valvet lägre än vanligt.</translation>
        </message>
        <message>
            <source>A surface was laid through {points} points.</source>
            <translation>En yta har lagts genom {points} punkter.</translation>
        </message>
        <message>
            <source>A taper over {taper_mm:g} mm is too long for an insole of {length_mm:.0f} mm; it tapers over half of its length. Shorten the taper.</source>
            <translation>En avsmalning över {taper_mm:g} mm är för lång för ett inlägg på {length_mm:.0f} mm; det smalnar av över halva sin längd. Förkorta avsmalningen.</translation>
        </message>
        <message>
            <source>A variant needs a name; type one.</source>
            <translation>En variant behöver ett namn; skriv ett.</translation>
        </message>
        <message>
            <source>A visit takes at most {most} photos; delete one first.</source>
            <translation>Ett besök tar högst {most} foton; ta bort ett först.</translation>
        </message>
        <message>
            <source>A wedge in the heel cup, medial or lateral</source>
            <translation>En kil i hälskålen, medialt eller lateralt</translation>
        </message>
        <message>
            <source>A {part} has only {count} usable points, but {least} are needed; move the sensor nearer and measure again.</source>
            <translation>En {part} har bara {count} användbara punkter, men {least} behövs; flytta sensorn närmare och mät igen.</translation>
        </message>
        <message>
            <source>A {side} foot by its shape: {reason}.</source>
            <translation>En {side} fot enligt formen: {reason}.</translation>
        </message>
        <message>
            <source>Accounts are off, although nobody has switched them off: anybody may do anything; switch them on again, and compare the record with a backup.</source>
            <translation>Konton är avslagna, fast ingen har slagit av dem: vem som helst får göra allt; slå på dem igen och jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>Accounts are on, although nobody has switched them on; compare the record with a backup.</source>
            <translation>Konton är påslagna, fast ingen har slagit på dem; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>Accounts are switched off; switch them on with the first administrator.</source>
            <translation>Kontona är avstängda; slå på dem med den första administratören.</translation>
        </message>
        <message>
            <source>Accounts are switched on already; sign in.</source>
            <translation>Kontona är redan påslagna; logga in.</translation>
        </message>
        <message>
            <source>Achilles axis against the normal of the sole; &gt; 0 leans medially (valgus)</source>
            <translation>akillesaxeln mot fotsulans normal; &gt; 0 lutar medialt (valgus)</translation>
        </message>
        <message>
            <source>Achilles axis against the upright of the scan; &gt; 0 leans medially</source>
            <translation>akillesaxeln mot skanningens lodlinje; &gt; 0 lutar medialt</translation>
        </message>
        <message>
            <source>Achilles lean: against the upright of the scan</source>
            <translation>Akilles lutning: mot skanningens lodlinje</translation>
        </message>
        <message>
            <source>Achilles tendinopathy</source>
            <translation>Hälsenebesvär</translation>
        </message>
        <message>
            <source>Achilles tendon</source>
            <translation>hälsena</translation>
        </message>
        <message>
            <source>Achilles to sole: against the normal of the sole</source>
            <translation>Akilles mot fotsula: mot fotsulans normal</translation>
        </message>
        <message>
            <source>Across</source>
            <translation>Tvärs</translation>
        </message>
        <message>
            <source>Added: {correction}, {values}</source>
            <translation>Nytt: {correction}, {values}</translation>
        </message>
        <message>
            <source>Adding pads</source>
            <translation>Lägger till pelotter</translation>
        </message>
        <message>
            <source>Adding persons</source>
            <translation>Lägger till personer</translation>
        </message>
        <message>
            <source>Address of the maker</source>
            <translation>Tillverkarens adress</translation>
        </message>
        <message>
            <source>Address, phone</source>
            <translation>Adress, telefon</translation>
        </message>
        <message>
            <source>All captures show a wall at the same distance, though other distances are given; capture a wall at each of them.</source>
            <translation>Alla bilder visar en vägg på samma avstånd, fast andra avstånd anges; ta en vägg på vart och ett av dem.</translation>
        </message>
        <message>
            <source>All places are millimetres along the axes of the machine, from the zero that the program is made for. The programs named above, with these SHA-256, belong to this sheet.</source>
            <translation>Alla lägen är millimeter längs maskinens axlar, från den nollpunkt som programmet är gjort för. Programmen ovan, med dessa SHA-256, hör till detta blad.</translation>
        </message>
        <message>
            <source>All walls lie at almost the same distance; capture {near:.0f} to {far:.0f} mm to learn how the distortion changes.</source>
            <translation>Alla väggar ligger på nästan samma avstånd; avbilda {near:.0f} till {far:.0f} mm för att lära hur distorsionen ändras.</translation>
        </message>
        <message>
            <source>All walls lie between {nearest_mm:.0f} and {farthest_mm:.0f} mm; capture walls from 600 to 900 mm, which show every dot at different pixels.</source>
            <translation>Alla väggar ligger mellan {nearest_mm:.0f} och {farthest_mm:.0f} mm; ta upp väggar på 600 till 900 mm, som visar varje punkt på olika bildpunkter.</translation>
        </message>
        <message>
            <source>All {count} lines are what was written, and none is missing.</source>
            <translation>Alla {count} rader är vad som skrevs, och ingen saknas.</translation>
        </message>
        <message>
            <source>Allowance around the heel</source>
            <translation>Tillägg runt hälen</translation>
        </message>
        <message>
            <source>Allowance in front of the longest toe</source>
            <translation>Tillägg framför den längsta tån</translation>
        </message>
        <message>
            <source>Allowance on both sides of the ball</source>
            <translation>Tillägg på trampdynans båda sidor</translation>
        </message>
        <message>
            <source>Along</source>
            <translation>Längs</translation>
        </message>
        <message>
            <source>Amputated forefoot</source>
            <translation>Amputerad framfot</translation>
        </message>
        <message>
            <source>An account is named by up to 60 letters, digits and the signs . _ - @, and begins with a letter or digit; choose such a name.</source>
            <translation>Ett konto har ett namn av högst 60 bokstäver, siffror och tecknen . _ - @, och börjar med en bokstav eller siffra; välj ett sådant namn.</translation>
        </message>
        <message>
            <source>An account needs the full name of its owner, of at most {most} characters; type it as papers print it.</source>
            <translation>Ett konto behöver ägarens fullständiga namn, högst {most} tecken; skriv det som det ska stå på papper.</translation>
        </message>
        <message>
            <source>An edge radius of {radius_mm:g} mm is more than half of the thickness; where the insole is {thickness_mm:g} mm thick, only {half_mm:g} mm of its edge are rounded. Make the radius smaller.</source>
            <translation>En kantradie på {radius_mm:g} mm är mer än halva tjockleken; där inlägget är {thickness_mm:g} mm tjockt rundas bara {half_mm:g} mm av kanten. Gör radien mindre.</translation>
        </message>
        <message>
            <source>An imprint, {depth_mm:.0f} mm deep, read as the sole that was pressed in.</source>
            <translation>Ett avtryck, {depth_mm:.0f} mm djupt, läst som den fotsula som tryckts ner.</translation>
        </message>
        <message>
            <source>An order needs one version of one or both feet of its visit; choose them again.</source>
            <translation>En beställning behöver en version av en fot eller av båda fötterna från sitt besök; välj dem igen.</translation>
        </message>
        <message>
            <source>Angle</source>
            <translation>Vinkel</translation>
        </message>
        <message>
            <source>Another capture is to be written to {path}; wait until it has ended, or choose another name.</source>
            <translation>En annan avbildning ska skrivas till {path}; vänta tills den är klar, eller välj ett annat namn.</translation>
        </message>
        <message>
            <source>Another person has the pseudonym {pseudonym}; choose another one.</source>
            <translation>En annan person har pseudonymen {pseudonym}; välj en annan.</translation>
        </message>
        <message>
            <source>Another person has the pseudonym {pseudonym}; correct it.</source>
            <translation>En annan person har pseudonymen {pseudonym}; rätta den.</translation>
        </message>
        <message>
            <source>Another program is making a backup in {folder}; wait until it is done.</source>
            <translation>Ett annat program gör en säkerhetskopia i {folder}; vänta tills det är klart.</translation>
        </message>
        <message>
            <source>Any number</source>
            <translation>Valfritt nummer</translation>
        </message>
        <message>
            <source>Approved: date and signature</source>
            <translation>Godkänt: datum och underskrift</translation>
        </message>
        <message>
            <source>Arch fill</source>
            <translation>Valvfyllnad</translation>
        </message>
        <message>
            <source>Arch raise</source>
            <translation>Valvhöjning</translation>
        </message>
        <message>
            <source>Arch support</source>
            <translation>Valvstöd</translation>
        </message>
        <message>
            <source>Arch transition</source>
            <translation>Övergång, hålfot</translation>
        </message>
        <message>
            <source>As scanned</source>
            <translation>Som skannad</translation>
        </message>
        <message>
            <source>At least three points are needed to place one frame in another, but only {count} were given.</source>
            <translation>Minst tre punkter behövs för att lägga ett koordinatsystem i ett annat, men bara {count} gavs.</translation>
        </message>
        <message>
            <source>At push-off the heel leaves the ground.</source>
            <translation>Vid frånskjut lämnar hälen underlaget.</translation>
        </message>
        <message>
            <source>At the heads</source>
            <translation>Vid huvudena</translation>
        </message>
        <message>
            <source>At the machine</source>
            <translation>Vid maskinen</translation>
        </message>
        <message>
            <source>Averaging the frames</source>
            <translation>Tar medel av bilderna</translation>
        </message>
        <message>
            <source>Averaging the frames of the view {view}</source>
            <translation>Tar medel av bilderna i vyn {view}</translation>
        </message>
        <message>
            <source>Back the record up: what is in it is lost if its disk fails.</source>
            <translation>Säkerhetskopiera journalen: det som finns i den går förlorat om dess disk går sönder.</translation>
        </message>
        <message>
            <source>Backing up files ({done} of {all})</source>
            <translation>Säkerhetskopierar filer ({done} av {all})</translation>
        </message>
        <message>
            <source>Backing up the tables ({rows} rows of {table})</source>
            <translation>Säkerhetskopierar tabellerna ({rows} rader av {table})</translation>
        </message>
        <message>
            <source>Backups have no passphrase yet; choose one first.</source>
            <translation>Säkerhetskopiorna har ännu ingen lösenfras; välj en först.</translation>
        </message>
        <message>
            <source>Ball</source>
            <translation>Trampdyna</translation>
        </message>
        <message>
            <source>Ball width</source>
            <translation>Trampdynans bredd</translation>
        </message>
        <message>
            <source>Baltic</source>
            <translation>Baltisk</translation>
        </message>
        <message>
            <source>Bar of 1 to 5; little fill.</source>
            <translation>Stav på 1 till 5; lite fyllnad.</translation>
        </message>
        <message>
            <source>Base</source>
            <translation>Bas</translation>
        </message>
        <message>
            <source>Base form</source>
            <translation>Grundform</translation>
        </message>
        <message>
            <source>Begins at</source>
            <translation>Börjar vid</translation>
        </message>
        <message>
            <source>Behind the heads</source>
            <translation>Bakom huvudena</translation>
        </message>
        <message>
            <source>Below which part of the shell the post stands</source>
            <translation>Under vilken del av skalet kilen står</translation>
        </message>
        <message>
            <source>Between bursts a motor tilts the sensor, and none of these has one: {serials}. Capture one series of each view, without bursts.</source>
            <translation>Mellan serierna lutar en motor sensorn, och ingen av dessa har någon: {serials}. Avbilda en serie av varje vy, utan flera serier.</translation>
        </message>
        <message>
            <source>Between {low_mm:.0f} and {high_mm:.0f} mm the distances are met within {error_mm:.1f} mm.</source>
            <translation>Mellan {low_mm:.0f} och {high_mm:.0f} mm träffas avstånden inom {error_mm:.1f} mm.</translation>
        </message>
        <message>
            <source>Block</source>
            <translation>Block</translation>
        </message>
        <message>
            <source>Block and zero</source>
            <translation>Block och nollpunkt</translation>
        </message>
        <message>
            <source>Body weight</source>
            <translation>Kroppsvikt</translation>
        </message>
        <message>
            <source>Border</source>
            <translation>Kant</translation>
        </message>
        <message>
            <source>Born</source>
            <translation>Född</translation>
        </message>
        <message>
            <source>Both feet in the scan look like a {side} one; say which foot is which.</source>
            <translation>Båda fötterna i skanningen ser ut som en {side}; ange vilken fot som är vilken.</translation>
        </message>
        <message>
            <source>Breadth over which the pad runs out; a share of its size if left out</source>
            <translation>Bredd över vilken pelotten löper ut; en andel av dess storlek om den utelämnas</translation>
        </message>
        <message>
            <source>Bright light outshines the dots in the infrared pictures, so they were hardly trusted on part of the foot ({shares}), and the deviation stated there is larger; keep sunlight and lamps off the foot.</source>
            <translation>Starkt ljus överstrålar punkterna i de infraröda bilderna, så de var knappt att lita på på en del av foten ({shares}), och den angivna avvikelsen där är större; håll solljus och lampor borta från foten.</translation>
        </message>
        <message>
            <source>Brush</source>
            <translation>Pensel</translation>
        </message>
        <message>
            <source>Brush stroke</source>
            <translation>Penseldrag</translation>
        </message>
        <message>
            <source>By its edges the diagonals of the printed bar are {edges:.1f} mm in the mean, but {diagonals:.1f} mm was read; measure edges and diagonals again.</source>
            <translation>Av sina kanter har den utskrivna staven diagonaler på i medel {edges:.1f} mm, men {diagonals:.1f} mm lästes av; mät kanter och diagonaler igen.</translation>
        </message>
        <message>
            <source>By its place in the box this is the {place} foot, by its shape a {told} one; say which foot it is.</source>
            <translation>Efter sin plats i lådan är detta {place} fot, efter sin form {told} fot; ange vilken fot det är.</translation>
        </message>
        <message>
            <source>By {wall} the pattern of {day} still holds: it has drifted by {drift_px:.3f} px, and the wall is like it ({likeness:.2f}).</source>
            <translation>Enligt {wall} gäller mönstret från {day} än: det har glidit {drift_px:.3f} px, och väggen liknar det ({likeness:.2f}).</translation>
        </message>
        <message>
            <source>Calibrate the sensors that you capture with: Tools ▸ Calibrate sensors.</source>
            <translation>Kalibrera de sensorer som du avbildar med: Verktyg ▸ Kalibrera sensorer.</translation>
        </message>
        <message>
            <source>Calibrated</source>
            <translation>Kalibrerad</translation>
        </message>
        <message>
            <source>Calibrating without {capture}</source>
            <translation>Kalibrerar utan {capture}</translation>
        </message>
        <message>
            <source>Calibration</source>
            <translation>Kalibrering</translation>
        </message>
        <message>
            <source>Capture</source>
            <translation>Avbildning</translation>
        </message>
        <message>
            <source>Capture the wall at about these distances: {distances} mm.</source>
            <translation>Ta väggen på ungefär dessa avstånd: {distances} mm.</translation>
        </message>
        <message>
            <source>Capturing view {views}</source>
            <translation>Avbildar vy {views}</translation>
        </message>
        <message>
            <source>Cavus foot</source>
            <translation>Hålfot</translation>
        </message>
        <message>
            <source>Central European</source>
            <translation>Centraleuropeisk</translation>
        </message>
        <message>
            <source>Central European, ISO</source>
            <translation>Centraleuropeisk, ISO</translation>
        </message>
        <message>
            <source>ChArUco {columns}×{rows}, square {square_mm:g} mm, marker {marker_mm:g} mm, {dictionary}</source>
            <translation>ChArUco {columns}×{rows}, ruta {square_mm:g} mm, markör {marker_mm:g} mm, {dictionary}</translation>
        </message>
        <message>
            <source>Chamfer</source>
            <translation>Fas</translation>
        </message>
        <message>
            <source>Change the outline of the pad</source>
            <translation>Ändra pelottens kontur</translation>
        </message>
        <message>
            <source>Changed: {correction}, {before} → {after}</source>
            <translation>Ändrat: {correction}, {before} → {after}</translation>
        </message>
        <message>
            <source>Checking the files of the backup</source>
            <translation>Kontrollerar säkerhetskopians filer</translation>
        </message>
        <message>
            <source>Checking the tables of the backup</source>
            <translation>Kontrollerar säkerhetskopians tabeller</translation>
        </message>
        <message>
            <source>Checking view {views}</source>
            <translation>Kontrollerar vy {views}</translation>
        </message>
        <message>
            <source>Checking: {check}</source>
            <translation>Kontrollerar: {check}</translation>
        </message>
        <message>
            <source>Checks before export</source>
            <translation>Kontroller före export</translation>
        </message>
        <message>
            <source>Chopart</source>
            <translation>Chopart</translation>
        </message>
        <message>
            <source>Clamps</source>
            <translation>Fastspänning</translation>
        </message>
        <message>
            <source>Clamps and turning</source>
            <translation>Fastspänning och vändning</translation>
        </message>
        <message>
            <source>Clinic</source>
            <translation>Klinik</translation>
        </message>
        <message>
            <source>Closing the insole</source>
            <translation>Inlägget sluts</translation>
        </message>
        <message>
            <source>Closing the {kind}</source>
            <translation>Sluter {kind}</translation>
        </message>
        <message>
            <source>Colour</source>
            <translation>Färg</translation>
        </message>
        <message>
            <source>Colour on depth, after a constant shift</source>
            <translation>Färg på djup, efter en fast förskjutning</translation>
        </message>
        <message>
            <source>Colour was shifted by {x:+.1f} px in x and {y:+.1f} px in y; up to {worst:.1f} px are left.</source>
            <translation>Färgen försköts {x:+.1f} px i x och {y:+.1f} px i y; upp till {worst:.1f} px är kvar.</translation>
        </message>
        <message>
            <source>Colouring the surface</source>
            <translation>Färglägger ytan</translation>
        </message>
        <message>
            <source>Common use of the element, which cites no study</source>
            <translation>Elementets vanliga användning, utan studie som källa</translation>
        </message>
        <message>
            <source>Compared part</source>
            <translation>Jämförd del</translation>
        </message>
        <message>
            <source>Compared: {lines} of the audit log {others}; {rows} (persons, visits, captures, prescriptions, orders, follow-ups, accounts with roles and passwords, settings) with what the log says of their last change; whether accounts are on; {signatures}; {files}, by their SHA-256. Not compared: who works where just now, failed sign-ins, and what is drawn from other rows, such as the words of the search.</source>
            <translation>Jämfört: {lines} i loggen {others}; {rows} (personer, besök, skanningar, ordinationer, beställningar, uppföljningar, konton med roller och lösenord, inställningar) med vad loggen säger om deras senaste ändring; om konton är påslagna; {signatures}; {files}, efter deras SHA-256. Inte jämfört: vem som arbetar var just nu, misslyckade inloggningar, och det som härleds ur andra rader, såsom sökorden.</translation>
        </message>
        <message>
            <source>Comparing the files</source>
            <translation>Jämför filerna</translation>
        </message>
        <message>
            <source>Comparing the record with the audit log</source>
            <translation>Jämför journalen med loggen</translation>
        </message>
        <message>
            <source>Comparing with the truth</source>
            <translation>Jämför med det sanna</translation>
        </message>
        <message>
            <source>Comparison of two surfaces</source>
            <translation>Jämförelse av två ytor</translation>
        </message>
        <message>
            <source>Computed by a model, in per cent, for one posture; no measurement and no promise: what a patient's foot does in the shoe only a measurement in the shoe tells.</source>
            <translation>Beräknat av en modell, i procent, för en ställning; ingen mätning och inget löfte: vad patientens fot gör i skon visar bara en mätning i skon.</translation>
        </message>
        <message>
            <source>Computed every</source>
            <translation>Beräknad var</translation>
        </message>
        <message>
            <source>Consent on</source>
            <translation>Samtycke den</translation>
        </message>
        <message>
            <source>Continuing the surface to the edges</source>
            <translation>Fortsätter ytan till kanterna</translation>
        </message>
        <message>
            <source>Copying {name}</source>
            <translation>{name} kopieras</translation>
        </message>
        <message>
            <source>Cork and EVA</source>
            <translation>Kork och EVA</translation>
        </message>
        <message>
            <source>Corners of a free-hand pad, from its highest place</source>
            <translation>Hörnen på en frihandspelott, från dess högsta punkt</translation>
        </message>
        <message>
            <source>Corrections</source>
            <translation>Korrigeringar</translation>
        </message>
        <message>
            <source>Cover</source>
            <translation>Överdrag</translation>
        </message>
        <message>
            <source>Cover is</source>
            <translation>Överdraget</translation>
        </message>
        <message>
            <source>Cover to the toes.</source>
            <translation>Överdrag till tårna.</translation>
        </message>
        <message>
            <source>Cuboid raise</source>
            <translation>Kuboidstöd</translation>
        </message>
        <message>
            <source>Cuboid syndrome</source>
            <translation>Kuboidsyndrom</translation>
        </message>
        <message>
            <source>Cup 10 to 14, rim 4 to 8, fill 0, flat underside, at least 3 under the heel: the usual values of clinics that mill EVA; flange and forefoot: Insole Studio's own choice</source>
            <translation>Hälskål 10 till 14, kant 4 till 8, fyllnad 0, plan undersida, minst 3 under hälen: vanliga värden på kliniker som fräser EVA; fläns och framfot: Insole Studios eget val</translation>
        </message>
        <message>
            <source>Cup 12 (Kevin Root clinic guide), fill 3.2 (Cox cast correction), ends behind the heads, shell of 3 with cupped underside and rearfoot post 4 wide at the edges (AOLabs, OpenFO)</source>
            <translation>Hälskål 12 (Kevin Root, klinikguide), fyllnad 3,2 (Cox, gipskorrigering), slutar bakom metatarsalhuvudena, skal på 3 med skålad undersida och bakfotskil, 4 bred vid kanterna (AOLabs, OpenFO)</translation>
        </message>
        <message>
            <source>Cup 14 (KLM), fill 1.6, shell with a cover of 3 to the toes; thickness by the weight of the body: Insole Studio's own choice</source>
            <translation>Hälskål 14 (KLM), fyllnad 1,6, skal med ett överdrag på 3 fram till tårna; tjocklek efter kroppsvikt: Insole Studios eget val</translation>
        </message>
        <message>
            <source>Cup 20 to 25, high medial and lateral flange, fill 1.6 (ProLab, pediatric), thickness 3 to 4</source>
            <translation>Hälskål 20 till 25, hög medial och lateral fläns, fyllnad 1,6 (ProLab, barn), tjocklek 3 till 4</translation>
        </message>
        <message>
            <source>Cup 8 to 10 (Podiatry Today), narrow by 3.2 (ProLab), fill 0 to 3.2, thickness 2 to 3</source>
            <translation>Hälskål 8 till 10 (Podiatry Today), 3,2 smalare (ProLab), fyllnad 0 till 3,2, tjocklek 2 till 3</translation>
        </message>
        <message>
            <source>Cup of 18 to 22.</source>
            <translation>Hälskål på 18 till 22.</translation>
        </message>
        <message>
            <source>Cup of 20 or more, rearfoot post.</source>
            <translation>Hälskål på 20 eller mer, bakfotskil.</translation>
        </message>
        <message>
            <source>Cut the tabs, and take the pieces out.</source>
            <translation>Skär av flikarna och ta ut styckena.</translation>
        </message>
        <message>
            <source>Cut-out</source>
            <translation>Urtag</translation>
        </message>
        <message>
            <source>Cutters, in the order in which they are needed</source>
            <translation>Fräsar, i den ordning de behövs</translation>
        </message>
        <message>
            <source>Cutting round the piece</source>
            <translation>Fräser runt stycket</translation>
        </message>
        <message>
            <source>Cutting the views where they overlap</source>
            <translation>Skär vyerna där de överlappar</translation>
        </message>
        <message>
            <source>Cyrillic</source>
            <translation>Kyrillisk</translation>
        </message>
        <message>
            <source>Cyrillic, ISO</source>
            <translation>Kyrillisk, ISO</translation>
        </message>
        <message>
            <source>Cyrillic, KOI8</source>
            <translation>Kyrillisk, KOI8</translation>
        </message>
        <message>
            <source>Dancer's pad</source>
            <translation>Dansarpelott</translation>
        </message>
        <message>
            <source>Date</source>
            <translation>Datum</translation>
        </message>
        <message>
            <source>Day</source>
            <translation>Dag</translation>
        </message>
        <message>
            <source>Delivery date</source>
            <translation>Leveransdag</translation>
        </message>
        <message>
            <source>Depth</source>
            <translation>Djup</translation>
        </message>
        <message>
            <source>Depth at the deepest place; below 0 it stands out of the insole</source>
            <translation>Djup i den djupaste punkten; under 0 sticker elementet upp ur inlägget</translation>
        </message>
        <message>
            <source>Depths at {distance_mm:.0f} mm differ by {share:+.1%} from the scale that was calibrated before, and one of the two is wrong; measure the side of the board's square, and the distances of the walls from the front of the sensor.</source>
            <translation>Djup vid {distance_mm:.0f} mm avviker med {share:+.1%} från den skala som kalibrerades förut, och en av de två är fel; mät sidan på brädets ruta, och väggarnas avstånd från sensorns framsida.</translation>
        </message>
        <message>
            <source>Designed by</source>
            <translation>Utformad av</translation>
        </message>
        <message>
            <source>Deviation of the triangles</source>
            <translation>Trianglarnas avvikelse</translation>
        </message>
        <message>
            <source>Device</source>
            <translation>Inläggstyp</translation>
        </message>
        <message>
            <source>Diabetes with loss of sensation</source>
            <translation>Diabetes med känselbortfall</translation>
        </message>
        <message>
            <source>Diabetic, full length</source>
            <translation>Diabetes, hel längd</translation>
        </message>
        <message>
            <source>Difference</source>
            <translation>Skillnad</translation>
        </message>
        <message>
            <source>Disk</source>
            <translation>Disk</translation>
        </message>
        <message>
            <source>Distance from the stroke beyond which nothing changes</source>
            <translation>Avstånd från draget bortom vilket inget ändras</translation>
        </message>
        <message>
            <source>Distance of the highest place from the back of the heel</source>
            <translation>Högsta punktens avstånd från hälens bakkant</translation>
        </message>
        <message>
            <source>Distance of the highest place from the foot axis; &gt; 0 is medial</source>
            <translation>Högsta punktens avstånd från fotaxeln; &gt; 0 är medialt</translation>
        </message>
        <message>
            <source>Distance of the line behind heads 1 and 5; &lt; 0 is ahead of them</source>
            <translation>Linjens avstånd bakom huvud 1 och 5; &lt; 0 är framför dem</translation>
        </message>
        <message>
            <source>Distance of the points that the surface is computed at</source>
            <translation>Avstånd mellan punkterna som ytan beräknas i</translation>
        </message>
        <message>
            <source>Distortion of the pattern, raw units</source>
            <translation>Mönstrets förvrängning, råenheter</translation>
        </message>
        <message>
            <source>Dowels, from the zero</source>
            <translation>Styrpinnar, från nollpunkten</translation>
        </message>
        <message>
            <source>Draft and chamfer of the walls are those of the prescription's shell; those of the order are not used.</source>
            <translation>Väggarnas släppning och fas är de som ordinationens skal anger; beställningens används inte.</translation>
        </message>
        <message>
            <source>Draft of the walls</source>
            <translation>Väggarnas släppning</translation>
        </message>
        <message>
            <source>Drag to change the outline</source>
            <translation>Dra för att ändra konturen</translation>
        </message>
        <message>
            <source>Drag to make it longer or shorter</source>
            <translation>Dra för att göra den längre eller kortare</translation>
        </message>
        <message>
            <source>Drag to make it wider or narrower</source>
            <translation>Dra för att göra den bredare eller smalare</translation>
        </message>
        <message>
            <source>Drag to move the line from which the underside rises</source>
            <translation>Dra för att flytta linjen där undersidan börjar stiga</translation>
        </message>
        <message>
            <source>Drag to move the pad</source>
            <translation>Dra för att flytta pelotten</translation>
        </message>
        <message>
            <source>Drag to turn the pad</source>
            <translation>Dra för att vrida pelotten</translation>
        </message>
        <message>
            <source>Drag up or down to change the forefoot angle</source>
            <translation>Dra upp eller ned för att ändra framfotens vinkel</translation>
        </message>
        <message>
            <source>Drag up or down to change the rearfoot angle</source>
            <translation>Dra upp eller ned för att ändra bakfotens vinkel</translation>
        </message>
        <message>
            <source>Drag up to raise the pad, down to lower it</source>
            <translation>Dra uppåt för att höja pelotten, nedåt för att sänka</translation>
        </message>
        <message>
            <source>Drawing the foot</source>
            <translation>Foten ritas</translation>
        </message>
        <message>
            <source>Drawing the piece</source>
            <translation>Ritar stycket</translation>
        </message>
        <message>
            <source>Drawn outline</source>
            <translation>Ritad kontur</translation>
        </message>
        <message>
            <source>Dress, three-quarter</source>
            <translation>Finsko, trekvarts</translation>
        </message>
        <message>
            <source>Due</source>
            <translation>Klar senast</translation>
        </message>
        <message>
            <source>EU size</source>
            <translation>EU-storlek</translation>
        </message>
        <message>
            <source>EVA pair</source>
            <translation>EVA par</translation>
        </message>
        <message>
            <source>EVA pair, large</source>
            <translation>EVA par, stor</translation>
        </message>
        <message>
            <source>EVA pair, low</source>
            <translation>EVA par, låg</translation>
        </message>
        <message>
            <source>EVA single</source>
            <translation>EVA enkel</translation>
        </message>
        <message>
            <source>EVA single, low</source>
            <translation>EVA enkel, låg</translation>
        </message>
        <message>
            <source>EVA, full length</source>
            <translation>EVA, hel längd</translation>
        </message>
        <message>
            <source>Edge</source>
            <translation>Kant</translation>
        </message>
        <message>
            <source>Edge of the heel that is raised</source>
            <translation>Den kant av hälen som höjs</translation>
        </message>
        <message>
            <source>Edge radius</source>
            <translation>Kantradie</translation>
        </message>
        <message>
            <source>Ends at</source>
            <translation>Slutar vid</translation>
        </message>
        <message>
            <source>English sizes of 8.47 mm, with 15 mm before the toes</source>
            <translation>engelska storlekar om 8,47 mm, med 15 mm framför tårna</translation>
        </message>
        <message>
            <source>Every capture needs a raw number and a distance; measure the missing ones.</source>
            <translation>Varje tagning behöver ett råtal och ett avstånd; mät dem som saknas.</translation>
        </message>
        <message>
            <source>Exporting orders</source>
            <translation>Exporterar beställningar</translation>
        </message>
        <message>
            <source>Exporting the order {number}</source>
            <translation>Beställningen {number} exporteras</translation>
        </message>
        <message>
            <source>Exporting the visit of {day}</source>
            <translation>Exporterar besöket {day}</translation>
        </message>
        <message>
            <source>Extent</source>
            <translation>Längd</translation>
        </message>
        <message>
            <source>Extrinsic turns the whole insole, intrinsic leaves its rim as it is</source>
            <translation>Extern vrider hela inlägget, intern lämnar dess kant som den är</translation>
        </message>
        <message>
            <source>Face {face}: {across} to the right, {along} downwards</source>
            <translation>Sida {face}: {across} åt höger, {along} nedåt</translation>
        </message>
        <message>
            <source>Family name</source>
            <translation>Efternamn</translation>
        </message>
        <message>
            <source>Feet</source>
            <translation>Fötter</translation>
        </message>
        <message>
            <source>Fewer than two points of the object were measured; mark them again.</source>
            <translation>Färre än två punkter på föremålet mättes; märk dem igen.</translation>
        </message>
        <message>
            <source>File</source>
            <translation>Fil</translation>
        </message>
        <message>
            <source>Files</source>
            <translation>Filer</translation>
        </message>
        <message>
            <source>Files of an earlier program ({files}) would lie beside {path}, and a shop could run both; remove them, or give the program another name.</source>
            <translation>Filer från ett tidigare program ({files}) skulle ligga bredvid {path}, och verkstaden kunde köra båda; ta bort dem eller ge programmet ett annat namn.</translation>
        </message>
        <message>
            <source>Files of an earlier program ({files}) would lie beside {path}, which has none, and a shop could run them; remove them, or give the nest another name.</source>
            <translation>Filer från ett tidigare program ({files}) skulle ligga bredvid {path}, som inte har något, och verkstaden kunde köra dem; ta bort dem eller ge samläggningen ett annat namn.</translation>
        </message>
        <message>
            <source>Fill these parts of the picture with the wall: {regions}.</source>
            <translation>Fyll dessa delar av bilden med väggen: {regions}.</translation>
        </message>
        <message>
            <source>Filler for the 1st toe</source>
            <translation>Utfyllnad för första tån</translation>
        </message>
        <message>
            <source>Filler for the 2nd toe</source>
            <translation>Utfyllnad för andra tån</translation>
        </message>
        <message>
            <source>Filler for the 3rd toe</source>
            <translation>Utfyllnad för tredje tån</translation>
        </message>
        <message>
            <source>Filler for the 4th toe</source>
            <translation>Utfyllnad för fjärde tån</translation>
        </message>
        <message>
            <source>Filler for the 5th toe</source>
            <translation>Utfyllnad för femte tån</translation>
        </message>
        <message>
            <source>Finding heel and toes</source>
            <translation>Söker häl och tår</translation>
        </message>
        <message>
            <source>Finding the markers of the view {view}</source>
            <translation>Söker markörerna i vyn {view}</translation>
        </message>
        <message>
            <source>Finding the markers of {view}</source>
            <translation>Söker markörerna i {view}</translation>
        </message>
        <message>
            <source>Finding the pose of the foot</source>
            <translation>Söker fotens läge</translation>
        </message>
        <message>
            <source>Finding the wall in {capture}</source>
            <translation>Söker väggen i {capture}</translation>
        </message>
        <message>
            <source>Findings</source>
            <translation>Fynd</translation>
        </message>
        <message>
            <source>Finished height</source>
            <translation>Färdig höjd</translation>
        </message>
        <message>
            <source>Finishing</source>
            <translation>Utformning av kanten</translation>
        </message>
        <message>
            <source>Finishing rim and toe zone</source>
            <translation>Färdigställer rand och tåzon</translation>
        </message>
        <message>
            <source>Finishing the surface</source>
            <translation>Finfräser ytan</translation>
        </message>
        <message>
            <source>Fitting both cameras to {count} boards</source>
            <translation>Passar båda kamerorna mot {count} bräden</translation>
        </message>
        <message>
            <source>Fitting one surface to the other</source>
            <translation>Passar den ena ytan mot den andra</translation>
        </message>
        <message>
            <source>Fitting the camera to {count} pictures</source>
            <translation>Passar kameran mot {count} bilder</translation>
        </message>
        <message>
            <source>Fitting the depth camera to {count} boards</source>
            <translation>Passar djupkameran mot {count} bräden</translation>
        </message>
        <message>
            <source>Fitting the disparity model</source>
            <translation>Passar disparitetsmodellen</translation>
        </message>
        <message>
            <source>Fitting the skew</source>
            <translation>Passar skevheten</translation>
        </message>
        <message>
            <source>Flat</source>
            <translation>Plan</translation>
        </message>
        <message>
            <source>Flat on the ground, or cupped: everywhere as thick below the foot</source>
            <translation>Plan mot underlaget, eller skålad: överallt lika tjock under foten</translation>
        </message>
        <message>
            <source>Flat pad</source>
            <translation>Plan pelott</translation>
        </message>
        <message>
            <source>Flatfoot of a child</source>
            <translation>Plattfot hos barn</translation>
        </message>
        <message>
            <source>Flatfoot of an adult</source>
            <translation>Plattfot hos vuxen</translation>
        </message>
        <message>
            <source>Folders</source>
            <translation>Mappar</translation>
        </message>
        <message>
            <source>Follow-up</source>
            <translation>Uppföljning</translation>
        </message>
        <message>
            <source>Foot length</source>
            <translation>Fotlängd</translation>
        </message>
        <message>
            <source>Foot ready</source>
            <translation>Foten är klar</translation>
        </message>
        <message>
            <source>For {weight_kg:g} kg of body weight, {material} is usually {usual_mm:g} mm thick, and this insole is {thickness_mm:g} mm.</source>
            <translation>För {weight_kg:g} kg kroppsvikt är {material} vanligen {usual_mm:g} mm tjockt, och det här inlägget är {thickness_mm:g} mm.</translation>
        </message>
        <message>
            <source>Forefoot</source>
            <translation>Framfot</translation>
        </message>
        <message>
            <source>Forefoot filler</source>
            <translation>Framfotsutfyllnad</translation>
        </message>
        <message>
            <source>Forefoot from</source>
            <translation>Framfot från</translation>
        </message>
        <message>
            <source>Forefoot post</source>
            <translation>Framfotskil</translation>
        </message>
        <message>
            <source>Forefoot supinatus</source>
            <translation>Framfotssupinatus</translation>
        </message>
        <message>
            <source>Forefoot that hurts when it rolls off</source>
            <translation>Smärta vid frånskjut</translation>
        </message>
        <message>
            <source>Forefoot transition</source>
            <translation>Övergång, framfot</translation>
        </message>
        <message>
            <source>Forefoot twist</source>
            <translation>Framfotsvridning</translation>
        </message>
        <message>
            <source>Form</source>
            <translation>Form</translation>
        </message>
        <message>
            <source>Free some space: a session takes about 100 MB, a backup more.</source>
            <translation>Frigör utrymme: en session tar ungefär 100 MB, en säkerhetskopia mer.</translation>
        </message>
        <message>
            <source>Free-hand pad</source>
            <translation>Frihandspelott</translation>
        </message>
        <message>
            <source>From axis</source>
            <translation>Från axeln</translation>
        </message>
        <message>
            <source>From heel</source>
            <translation>Från hälen</translation>
        </message>
        <message>
            <source>From which, with the material, a thickness is proposed</source>
            <translation>Ur vilken, tillsammans med materialet, en tjocklek föreslås</translation>
        </message>
        <message>
            <source>Front edge</source>
            <translation>Framkant</translation>
        </message>
        <message>
            <source>Full from</source>
            <translation>Full från</translation>
        </message>
        <message>
            <source>Full up to</source>
            <translation>Full till</translation>
        </message>
        <message>
            <source>Full-length lift</source>
            <translation>Hel höjning</translation>
        </message>
        <message>
            <source>Fullness across</source>
            <translation>Fyllighet tvärs</translation>
        </message>
        <message>
            <source>Fullness across and along</source>
            <translation>Fyllighet tvärs och längs</translation>
        </message>
        <message>
            <source>Fullness along</source>
            <translation>Fyllighet längs</translation>
        </message>
        <message>
            <source>Functional hallux limitus</source>
            <translation>Funktionell hallux limitus</translation>
        </message>
        <message>
            <source>Functional, three-quarter</source>
            <translation>Funktionell, trekvarts</translation>
        </message>
        <message>
            <source>Give the known length in mm, between two different markers.</source>
            <translation>Ange den kända längden i mm, mellan två olika markörer.</translation>
        </message>
        <message>
            <source>Given name</source>
            <translation>Förnamn</translation>
        </message>
        <message>
            <source>Graphics</source>
            <translation>Grafik</translation>
        </message>
        <message>
            <source>Greatest height of the wedge in the heel cup</source>
            <translation>Kilens största höjd i hälskålen</translation>
        </message>
        <message>
            <source>Greek</source>
            <translation>Grekisk</translation>
        </message>
        <message>
            <source>HMP Global Learning Network</source>
            <translation>HMP Global Learning Network</translation>
        </message>
        <message>
            <source>Hallux rigidus</source>
            <translation>Hallux rigidus</translation>
        </message>
        <message>
            <source>Have an administrator copy {rule} to /etc/udev/rules.d, then unplug the sensors and plug them in again.</source>
            <translation>Låt en administratör kopiera {rule} till /etc/udev/rules.d; dra sedan ut sensorerna och anslut dem igen.</translation>
        </message>
        <message>
            <source>Head {number}</source>
            <translation>Huvud {number}</translation>
        </message>
        <message>
            <source>Heel</source>
            <translation>Häl</translation>
        </message>
        <message>
            <source>Heel and ball of this foot lie in an impossible order, so no form of the library can be laid on it; choose a base from the foot, or scan again.</source>
            <translation>Fotens häl och trampdyna ligger i en omöjlig ordning, så ingen form ur biblioteket kan läggas på den; välj foten som bas eller skanna igen.</translation>
        </message>
        <message>
            <source>Heel and toe were clicked {length_mm:.0f} mm from each other, which is no foot; click the end of the heel, the tip of a toe and the sole again.</source>
            <translation>Häl och tå klickades {length_mm:.0f} mm från varandra, vilket inte är någon fot; klicka på hälens ände, en tåspets och sulan igen.</translation>
        </message>
        <message>
            <source>Heel cup</source>
            <translation>Hälskål</translation>
        </message>
        <message>
            <source>Heel lift</source>
            <translation>Hälhöjning</translation>
        </message>
        <message>
            <source>Heel or toes of this foot were not scanned: its length is a guess, so no size is proposed. Put in the EU size of the shoe.</source>
            <translation>Fotens häl eller tår skannades inte: längden är en gissning, så ingen storlek föreslås. Skriv in skons EU-storlek.</translation>
        </message>
        <message>
            <source>Heel or toes of this foot were not scanned: its length is a guess, so no size is proposed. Put in the size of the shoe.</source>
            <translation>Fotens häl eller tår skannades inte: längden är en gissning, så ingen storlek föreslås. Skriv in skons storlek.</translation>
        </message>
        <message>
            <source>Heel or toes were pressed in by {depth_mm:.0f} mm only: the length is some millimetres smaller than that of the foot.</source>
            <translation>Häl eller tår trycktes ner bara {depth_mm:.0f} mm: längden är några millimeter mindre än fotens.</translation>
        </message>
        <message>
            <source>Heel pitch</source>
            <translation>Klackhöjd</translation>
        </message>
        <message>
            <source>Heel skive</source>
            <translation>Hälskivning</translation>
        </message>
        <message>
            <source>Heel spur</source>
            <translation>Hälsporre</translation>
        </message>
        <message>
            <source>Heel transition</source>
            <translation>Övergång, häl</translation>
        </message>
        <message>
            <source>Heel, 1st and 5th head lie on one line; put them in place.</source>
            <translation>Häl, 1:a och 5:e huvudet ligger på en linje; sätt dem på plats.</translation>
        </message>
        <message>
            <source>Heel-spur recess</source>
            <translation>Hälsporreurtag</translation>
        </message>
        <message>
            <source>Height</source>
            <translation>Höjd</translation>
        </message>
        <message>
            <source>Height at the highest place; below 0 it is a recess</source>
            <translation>Höjd i den högsta punkten; under 0 blir det en urgröpning</translation>
        </message>
        <message>
            <source>Height of the finished arch over the underside of the insole</source>
            <translation>Det färdiga fotvalvets höjd över inläggets undersida</translation>
        </message>
        <message>
            <source>Height of the rim at this station over its level</source>
            <translation>Kantens höjd vid denna kantpunkt, över dess nivå</translation>
        </message>
        <message>
            <source>Height of the rim over the lowest place of the heel</source>
            <translation>Kantens höjd över hälens lägsta punkt</translation>
        </message>
        <message>
            <source>Height of the shoe's heel over its forefoot</source>
            <translation>Hur mycket högre skons häl är än dess framfot</translation>
        </message>
        <message>
            <source>Height over the ground up to which the insole follows the foot</source>
            <translation>Höjd över underlaget upp till vilken inlägget följer foten</translation>
        </message>
        <message>
            <source>Heights</source>
            <translation>Höjder</translation>
        </message>
        <message>
            <source>Heights from above</source>
            <translation>Höjder ovanifrån</translation>
        </message>
        <message>
            <source>Heights of sole and insole in mm, seen from above</source>
            <translation>Höjder av fotsula och inlägg i mm, sedda uppifrån</translation>
        </message>
        <message>
            <source>Hold the board in these parts of the picture: {regions}.</source>
            <translation>Håll brädet i dessa delar av bilden: {regions}.</translation>
        </message>
        <message>
            <source>How far ahead of the metatarsal heads the toe zone begins</source>
            <translation>Hur långt framför metatarsalhuvudena tåzonen börjar</translation>
        </message>
        <message>
            <source>How far the height spreads across the pad; more makes it fuller</source>
            <translation>Hur långt höjden breder ut sig tvärs pelotten; mer gör den fylligare</translation>
        </message>
        <message>
            <source>How far the height spreads along the pad; more makes it fuller</source>
            <translation>Hur långt höjden breder ut sig längs pelotten; mer gör den fylligare</translation>
        </message>
        <message>
            <source>How far the medial arch is lowered below the scan</source>
            <translation>Hur mycket det mediala valvet sänks under skanningen</translation>
        </message>
        <message>
            <source>How far the post reaches; by its region if left out</source>
            <translation>Hur långt kilen når; efter sitt område om den utelämnas</translation>
        </message>
        <message>
            <source>How far the surface is computed beside the foot</source>
            <translation>Hur långt bredvid foten ytan beräknas</translation>
        </message>
        <message>
            <source>How much narrower the rear end is than the front; 0 % is an ellipse</source>
            <translation>Hur mycket smalare bakre änden är än den främre; 0 % är en ellips</translation>
        </message>
        <message>
            <source>How much of the height the metatarsal heads are raised</source>
            <translation>Hur stor del av höjden metatarsalhuvudena höjs</translation>
        </message>
        <message>
            <source>How much the arch is raised at its highest place</source>
            <translation>Hur mycket valvet höjs i sin högsta punkt</translation>
        </message>
        <message>
            <source>How much the heel is raised</source>
            <translation>Hur mycket hälen höjs</translation>
        </message>
        <message>
            <source>How much the material {material} gives way is not known; put its Shore A hardness or its modulus into the table of materials, or name another material.</source>
            <translation>Hur mycket materialet {material} ger efter är inte känt; ange dess hårdhet i Shore A eller dess modul i materialtabellen, eller välj ett annat material.</translation>
        </message>
        <message>
            <source>How much the stroke raises or lowers</source>
            <translation>Hur mycket draget höjer eller sänker</translation>
        </message>
        <message>
            <source>Identification</source>
            <translation>Identifiering</translation>
        </message>
        <message>
            <source>Identification on it</source>
            <translation>Märkning på inlägget</translation>
        </message>
        <message>
            <source>In the place of the {side} foot the shape looks like a {other} one; see that the two feet are of one person, and stand in their own places.</source>
            <translation>På platsen för {side} fot liknar formen en {other} fot; se till att de båda fötterna hör till en person och står på sina egna platser.</translation>
        </message>
        <message>
            <source>In the view {view} nothing of {least_mm:g} to {most_mm:g} mm stands out from its background; lay the mould or insole alone on a flat table under the sensor, and record it again.</source>
            <translation>I vyn {view} avtecknar sig inget på {least_mm:g} till {most_mm:g} mm mot bakgrunden; lägg formen eller inlägget ensamt på ett plant bord under sensorn, och spela in igen.</translation>
        </message>
        <message>
            <source>In the view {view} {reason}.</source>
            <translation>I vyn {view}: {reason}.</translation>
        </message>
        <message>
            <source>Inclination of the lateral wall; &gt; 0 is wider at the bottom</source>
            <translation>Den laterala väggens lutning; &gt; 0 är bredare nedtill</translation>
        </message>
        <message>
            <source>Inclination of the medial wall; &gt; 0 is wider at the bottom</source>
            <translation>Den mediala väggens lutning; &gt; 0 är bredare nedtill</translation>
        </message>
        <message>
            <source>Infrared pictures of dots are those of Kinects with a matching window; leave out ideal and stereo sensors, or the infrared pictures and what disturbs them.</source>
            <translation>Infraröda bilder av prickar tas av Kinect-sensorer med matchningsfönster; utelämna ideala sensorer och stereokameror, eller de infraröda bilderna och det som stör dem.</translation>
        </message>
        <message>
            <source>Inside</source>
            <translation>Insida</translation>
        </message>
        <message>
            <source>Insole</source>
            <translation>Inlägg</translation>
        </message>
        <message>
            <source>Insole Studio, from the usual values of the device</source>
            <translation>Insole Studio, efter inläggstypens vanliga värden</translation>
        </message>
        <message>
            <source>Insole built</source>
            <translation>Inlägget är byggt</translation>
        </message>
        <message>
            <source>Install the driver of the graphics card, or start with the environment variable LIBGL_ALWAYS_SOFTWARE=1 (Windows: QT_OPENGL=software), which draws slowly.</source>
            <translation>Installera grafikkortets drivrutin, eller starta med miljövariabeln LIBGL_ALWAYS_SOFTWARE=1 (Windows: QT_OPENGL=software), som ritar långsamt.</translation>
        </message>
        <message>
            <source>It has no date of a visit; open it and choose one.</source>
            <translation>Det saknar besöksdatum; öppna det och välj ett.</translation>
        </message>
        <message>
            <source>It is more than a year old: check it, or calibrate the sensor again.</source>
            <translation>Den är mer än ett år gammal: kontrollera den, eller kalibrera sensorn igen.</translation>
        </message>
        <message>
            <source>It is the same as {name}.</source>
            <translation>Det är detsamma som {name}.</translation>
        </message>
        <message>
            <source>It is {name}, {born}.</source>
            <translation>Det är {name}, {born}.</translation>
        </message>
        <message>
            <source>It names nobody whom the record knows; type the patient's name.</source>
            <translation>Det nämner ingen som finns i journalen; skriv patientens namn.</translation>
        </message>
        <message>
            <source>It shares USB controller {bus} with another sensor, so the two take turns; plug one into a controller of its own to capture with both at once.</source>
            <translation>Den delar USB-styrenhet {bus} med en annan sensor, så de två turas om; anslut den ena till en egen styrenhet för att avbilda med båda samtidigt.</translation>
        </message>
        <message>
            <source>It was set by hand that it is a {side} foot.</source>
            <translation>Det sattes för hand att det är en {side} fot.</translation>
        </message>
        <message>
            <source>Its motor does not run, because its audio firmware is not loaded; tilt it by hand.</source>
            <translation>Dess motor går inte, eftersom ljuddelens fasta program inte är laddat; luta den för hand.</translation>
        </message>
        <message>
            <source>Job sheet for custom insoles</source>
            <translation>Arbetsblad för individuella inlägg</translation>
        </message>
        <message>
            <source>Joining the views</source>
            <translation>Fogar ihop vyerna</translation>
        </message>
        <message>
            <source>Jones fracture</source>
            <translation>Jonesfraktur</translation>
        </message>
        <message>
            <source>Journal of Foot and Ankle Research 7:18; Yonsei Med J 2022;63(9):864</source>
            <translation>Journal of Foot and Ankle Research 7:18; Yonsei Med J 2022;63(9):864</translation>
        </message>
        <message>
            <source>Judging the map</source>
            <translation>Bedömer kartan</translation>
        </message>
        <message>
            <source>Kept beside the version of another station</source>
            <translation>Behållen bredvid versionen från en annan station</translation>
        </message>
        <message>
            <source>Kevin Root Medical, forum</source>
            <translation>Kevin Root Medical, forum</translation>
        </message>
        <message>
            <source>Kevin Root Medical, forum; Cox cast correction</source>
            <translation>Kevin Root Medical, forum; Cox, gipskorrigering</translation>
        </message>
        <message>
            <source>Kind</source>
            <translation>Typ</translation>
        </message>
        <message>
            <source>Kind of personal number</source>
            <translation>Slag av personnummer</translation>
        </message>
        <message>
            <source>Kirby, Podiatry Today</source>
            <translation>Kirby, Podiatry Today</translation>
        </message>
        <message>
            <source>Lateral draft</source>
            <translation>Lutning lateralt</translation>
        </message>
        <message>
            <source>Lateral instability</source>
            <translation>Lateral instabilitet</translation>
        </message>
        <message>
            <source>Lateral rim</source>
            <translation>Lateral kant</translation>
        </message>
        <message>
            <source>Lateral rim, from heel to toes</source>
            <translation>Lateral kant, från häl till tår</translation>
        </message>
        <message>
            <source>Lateral skive of 2 to 3.</source>
            <translation>Lateral skivning på 2 till 3.</translation>
        </message>
        <message>
            <source>Lay the block as in the picture, clamp it, and set the zero.</source>
            <translation>Lägg blocket som på bilden, spänn fast det och ställ nollpunkten.</translation>
        </message>
        <message>
            <source>Layers</source>
            <translation>Lager</translation>
        </message>
        <message>
            <source>Laying the grid over the sole</source>
            <translation>Lägger rutnätet över fotsulan</translation>
        </message>
        <message>
            <source>Laying {name} on {first}</source>
            <translation>Lägger {name} på {first}</translation>
        </message>
        <message>
            <source>Learning the pattern of dots</source>
            <translation>Lär in punktmönstret</translation>
        </message>
        <message>
            <source>Least thickness</source>
            <translation>Minsta tjocklek</translation>
        </message>
        <message>
            <source>Least thickness at the front edge</source>
            <translation>Minsta tjocklek vid framkanten</translation>
        </message>
        <message>
            <source>Least thickness under the foot, before pads and recesses</source>
            <translation>Minsta tjocklek under foten, före pelotter och urgröpningar</translation>
        </message>
        <message>
            <source>Least thickness, without the rim</source>
            <translation>Minsta tjocklek, utan kanten</translation>
        </message>
        <message>
            <source>Leaving one wall out needs captures at {least} distances or more, but there are {count}; capture more.</source>
            <translation>För att utelämna en vägg behövs tagningar på {least} avstånd eller fler, men det finns {count}; ta fler.</translation>
        </message>
        <message>
            <source>Left foot minus right foot</source>
            <translation>Vänster fot minus höger fot</translation>
        </message>
        <message>
            <source>Left insole</source>
            <translation>Vänster inlägg</translation>
        </message>
        <message>
            <source>Left of the shifts (rms)</source>
            <translation>Kvar av förskjutningarna (rms)</translation>
        </message>
        <message>
            <source>Leg length discrepancy</source>
            <translation>Benlängdsskillnad</translation>
        </message>
        <message>
            <source>Leg length discrepancy above 6 mm</source>
            <translation>Benlängdsskillnad över 6 mm</translation>
        </message>
        <message>
            <source>Length</source>
            <translation>Längd</translation>
        </message>
        <message>
            <source>Length of the pad</source>
            <translation>Pelottens längd</translation>
        </message>
        <message>
            <source>Length of the zone that is raised</source>
            <translation>Längd på området som höjs</translation>
        </message>
        <message>
            <source>Length over which the shell gets as thin as its front edge</source>
            <translation>Sträcka över vilken skalet blir så tunt som framkanten</translation>
        </message>
        <message>
            <source>Length × width × height</source>
            <translation>Längd × bredd × höjd</translation>
        </message>
        <message>
            <source>Let the underside rise ahead of a line along the heads</source>
            <translation>Låt undersidan stiga framför en linje längs huvudena</translation>
        </message>
        <message>
            <source>Lies</source>
            <translation>Ligger</translation>
        </message>
        <message>
            <source>Line {line} of {path} has {count} columns, and a table may have {most}; check its quotation marks.</source>
            <translation>Rad {line} i {path} har {count} kolumner, och en tabell får ha {most}; kontrollera citattecknen.</translation>
        </message>
        <message>
            <source>Line {number} of the audit log ({at}) is not what was written; compare it with a backup.</source>
            <translation>Rad {number} i loggen ({at}) är inte vad som skrevs; jämför med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>Line {number} of the audit log is missing; compare it with a backup.</source>
            <translation>Rad {number} i loggen saknas; jämför med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>Line {number} of the audit log is not the last one that was written; compare it with a backup.</source>
            <translation>Rad {number} i loggen är inte den sista som skrevs; jämför med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>Lisfranc</source>
            <translation>Lisfranc</translation>
        </message>
        <message>
            <source>Loading the foot</source>
            <translation>Belastar foten</translation>
        </message>
        <message>
            <source>Looking at both surfaces</source>
            <translation>Betraktar båda ytorna</translation>
        </message>
        <message>
            <source>Looking at {picture}</source>
            <translation>Tittar på {picture}</translation>
        </message>
        <message>
            <source>Looking for earlier designs</source>
            <translation>Söker tidigare designer</translation>
        </message>
        <message>
            <source>Looking for material that stays</source>
            <translation>Söker material som blir kvar</translation>
        </message>
        <message>
            <source>Looking for the board in {picture}</source>
            <translation>Söker brädet i {picture}</translation>
        </message>
        <message>
            <source>Looking for the board on {capture}</source>
            <translation>Söker brädet på {capture}</translation>
        </message>
        <message>
            <source>Machine</source>
            <translation>Maskin</translation>
        </message>
        <message>
            <source>Made with</source>
            <translation>Framställt med</translation>
        </message>
        <message>
            <source>Make a backup, and see why none was made: what was entered since is in no other place.</source>
            <translation>Gör en säkerhetskopia och se efter varför ingen har gjorts: det som skrivits in sedan dess finns ingen annanstans.</translation>
        </message>
        <message>
            <source>Maker</source>
            <translation>Tillverkare</translation>
        </message>
        <message>
            <source>Making the zones</source>
            <translation>Gör zonerna</translation>
        </message>
        <message>
            <source>Margin</source>
            <translation>Marginal</translation>
        </message>
        <message>
            <source>Material</source>
            <translation>Material</translation>
        </message>
        <message>
            <source>Material and make</source>
            <translation>Material och utförande</translation>
        </message>
        <message>
            <source>Material lot</source>
            <translation>Materialets parti</translation>
        </message>
        <message>
            <source>Material of the base</source>
            <translation>Basens material</translation>
        </message>
        <message>
            <source>Material of the cover</source>
            <translation>Överdragets material</translation>
        </message>
        <message>
            <source>Material of the middle layer</source>
            <translation>Mellanlagrets material</translation>
        </message>
        <message>
            <source>Measure</source>
            <translation>Mått</translation>
        </message>
        <message>
            <source>Measure the bar and the plate at one position at least.</source>
            <translation>Mät staven och plattan i minst ett läge.</translation>
        </message>
        <message>
            <source>Measures</source>
            <translation>Mått</translation>
        </message>
        <message>
            <source>Measures of the feet</source>
            <translation>Fötternas mått</translation>
        </message>
        <message>
            <source>Measuring the difference</source>
            <translation>Mäter skillnaden</translation>
        </message>
        <message>
            <source>Medial border against the bisection of the 1st metatarsal</source>
            <translation>Den mediala kanten mot mittlinjen av metatarsal 1</translation>
        </message>
        <message>
            <source>Medial draft</source>
            <translation>Lutning medialt</translation>
        </message>
        <message>
            <source>Medial flange</source>
            <translation>Medial fläns</translation>
        </message>
        <message>
            <source>Medial rim</source>
            <translation>Medial kant</translation>
        </message>
        <message>
            <source>Medial rim, from heel to toes</source>
            <translation>Medial kant, från häl till tår</translation>
        </message>
        <message>
            <source>Metatarsal bar</source>
            <translation>Tvärbalk</translation>
        </message>
        <message>
            <source>Metatarsal heads</source>
            <translation>Metatarsalhuvuden</translation>
        </message>
        <message>
            <source>Metatarsalgia</source>
            <translation>Metatarsalgi</translation>
        </message>
        <message>
            <source>Middle layer</source>
            <translation>Mellanlager</translation>
        </message>
        <message>
            <source>Midfoot</source>
            <translation>Mellanfot</translation>
        </message>
        <message>
            <source>Missing 1st toe</source>
            <translation>1:a tån saknas</translation>
        </message>
        <message>
            <source>Missing 2nd toe</source>
            <translation>2:a tån saknas</translation>
        </message>
        <message>
            <source>Missing 3rd toe</source>
            <translation>3:e tån saknas</translation>
        </message>
        <message>
            <source>Missing 4th toe</source>
            <translation>4:e tån saknas</translation>
        </message>
        <message>
            <source>Missing 5th toe</source>
            <translation>5:e tån saknas</translation>
        </message>
        <message>
            <source>Morton's extension</source>
            <translation>Mortons förlängning</translation>
        </message>
        <message>
            <source>Morton's neuroma, hammer toes</source>
            <translation>Mortons neurom, hammartår</translation>
        </message>
        <message>
            <source>Move the pad</source>
            <translation>Flytta pelotten</translation>
        </message>
        <message>
            <source>Move the rocker line</source>
            <translation>Flytta rullsulans linje</translation>
        </message>
        <message>
            <source>Moved or reshaped: {correction}</source>
            <translation>Flyttat eller omformat: {correction}</translation>
        </message>
        <message>
            <source>Name</source>
            <translation>Namn</translation>
        </message>
        <message>
            <source>Neither settings nor unsaved work can be kept: {reason}</source>
            <translation>Varken inställningar eller osparat arbete kan bevaras: {reason}</translation>
        </message>
        <message>
            <source>Nest</source>
            <translation>Samläggning</translation>
        </message>
        <message>
            <source>Nest of several orders</source>
            <translation>Samläggning av flera beställningar</translation>
        </message>
        <message>
            <source>Nesting the pieces</source>
            <translation>Lägger ut styckena</translation>
        </message>
        <message>
            <source>No board has depth at its corners; hold it 600 to 1500 mm from the sensor.</source>
            <translation>Inget bräde har djup vid sina hörn; håll det 600 till 1500 mm från sensorn.</translation>
        </message>
        <message>
            <source>No board of {folder} is seen by both cameras; give ir_003 and color_003 the same number when they show the same position.</source>
            <translation>Inget bräde i {folder} syns för båda kamerorna; ge ir_003 och color_003 samma nummer när de visar samma läge.</translation>
        </message>
        <message>
            <source>No browser could be opened; open {path} in one to read the manual.</source>
            <translation>Ingen webbläsare kunde öppnas; öppna {path} i en webbläsare för att läsa handboken.</translation>
        </message>
        <message>
            <source>No column holds the names; say which one does.</source>
            <translation>Ingen kolumn innehåller namnen; ange vilken som gör det.</translation>
        </message>
        <message>
            <source>No correction is learnt for sensors of this kind, so their depth is used as it is.</source>
            <translation>Ingen korrektion är inlärd för sensorer av detta slag, så deras djup används som det är.</translation>
        </message>
        <message>
            <source>No distance of the object was measured; mark its points again.</source>
            <translation>Inget avstånd på föremålet mättes; märk dess punkter igen.</translation>
        </message>
        <message>
            <source>No file of zones is chosen; choose one, or take the table.</source>
            <translation>Ingen fil med zoner är vald; välj en, eller ta tabellen.</translation>
        </message>
        <message>
            <source>No foot can be made from {session}, because none of its views can be used ({reasons}).</source>
            <translation>Ingen fot kan göras av {session}, eftersom ingen av dess vyer kan användas ({reasons}).</translation>
        </message>
        <message>
            <source>No footprint stands out on the picture; choose one with an even background, or lay it by hand.</source>
            <translation>Inget fotavtryck framträder på bilden; välj en bild med jämn bakgrund, eller lägg den för hand.</translation>
        </message>
        <message>
            <source>No last is chosen yet; choose its file.</source>
            <translation>Ingen läst är vald än; välj dess fil.</translation>
        </message>
        <message>
            <source>No part of this foot faces the ground, so no contact surface can be made; check the pose of the scan.</source>
            <translation>Ingen del av foten vetter mot underlaget, så ingen kontaktyta kan göras; kontrollera skanningens läge.</translation>
        </message>
        <message>
            <source>No pattern of dots of sensor {serial} is kept; learn it first.</source>
            <translation>Inget punktmönster för sensorn {serial} är sparat; lär in det först.</translation>
        </message>
        <message>
            <source>No point is marked in both images; mark the targets in colour and depth.</source>
            <translation>Ingen punkt är märkt i båda bilderna; märk målen i färg och djup.</translation>
        </message>
        <message>
            <source>No pressure on this sole has its centre where the load is; a part of the foot is missing in the scan, so scan the whole sole.</source>
            <translation>Inget tryck på den här sulan har sin mitt där belastningen är; en del av foten saknas i skanningen, så skanna hela sulan.</translation>
        </message>
        <message>
            <source>No program is installed that opens {names}; they are in {folder}.</source>
            <translation>Det finns inget program som öppnar {names}; de ligger i {folder}.</translation>
        </message>
        <message>
            <source>No published series has measured so much; the model overrates it.</source>
            <translation>Ingen publicerad serie har mätt så mycket; modellen överskattar det.</translation>
        </message>
        <message>
            <source>No sensor is plugged in; plug in its USB cable, and its power supply if it has one.</source>
            <translation>Ingen sensor är ansluten; anslut dess USB-kabel, och dess nätaggregat om den har ett.</translation>
        </message>
        <message>
            <source>No single toes are seen, as in a sock or where they melted together, so what lies at them is a guess; see that it is a foot, and no shoe last or prosthesis.</source>
            <translation>Inga enskilda tår syns, som i en strumpa eller där de flutit ihop, så det som ligger vid dem är en gissning; se efter att det är en fot och inte en läst eller en protes.</translation>
        </message>
        <message>
            <source>No tabs hold the pieces, and the last cut has set them free: wait till the cutter stands still, and take them out.</source>
            <translation>Inga flikar håller styckena, och sista snittet har frigjort dem: vänta tills fräsen står stilla och ta ut dem.</translation>
        </message>
        <message>
            <source>No thickness can be proposed without a material; choose one of {names}.</source>
            <translation>Ingen tjocklek kan föreslås utan material; välj ett av {names}.</translation>
        </message>
        <message>
            <source>No thickness can be proposed without the body weight; put in the weight, or the thickness itself.</source>
            <translation>Ingen tjocklek kan föreslås utan kroppsvikten; ange vikten, eller själva tjockleken.</translation>
        </message>
        <message>
            <source>No thickness is known for the material {material}; choose one of {names}, or put in the thickness yourself.</source>
            <translation>För materialet {material} är ingen tjocklek känd; välj ett av {names}, eller ange tjockleken själv.</translation>
        </message>
        <message>
            <source>No view has infrared pictures that can be used; use the sensors' own depth (chip). {reasons}</source>
            <translation>Ingen vy har infraröda bilder som kan användas; använd sensorernas eget djup (chip). {reasons}</translation>
        </message>
        <message>
            <source>No view shows the side of the markers "{face}", so the foot is not measured there.</source>
            <translation>Ingen vy visar sidan med markörerna ”{face}”, så foten är inte mätt där.</translation>
        </message>
        <message>
            <source>No view was named; say which sensor gives which view: left=SERIAL …</source>
            <translation>Ingen vy angavs; ange vilken sensor som ger vilken vy: left=SERIENUMMER …</translation>
        </message>
        <message>
            <source>No {what} of about {diameter_mm:.0f} mm was found in the volume of interest; put it in the middle of the volume, and check what was said of it.</source>
            <translation>Inget föremål av slaget {what} på ungefär {diameter_mm:.0f} mm hittades i mätvolymen; lägg det mitt i volymen och kontrollera uppgifterna om det.</translation>
        </message>
        <message>
            <source>Nobody has said whether weight was on the foot as it was scanned: with it the sole is flatter than without it, and reliefs are understated.</source>
            <translation>Ingen har sagt om foten var belastad när den skannades: då är sulan plattare än utan belastning, och avlastningarna blir för små.</translation>
        </message>
        <message>
            <source>Nobody has the pseudonym {pseudonym}; it stands on the patient's page and on papers for the shop.</source>
            <translation>Ingen har pseudonymen {pseudonym}; den står på patientens sida och på papper till verkstaden.</translation>
        </message>
        <message>
            <source>Noise covers the dots in the infrared pictures, so they were trusted less on part of the foot ({shares}), and the deviation stated there is larger; see that emitter and lens are clean and the skin is dry and matt, and move the sensor nearer.</source>
            <translation>Brus döljer punkterna i de infraröda bilderna, så de var mindre att lita på på en del av foten ({shares}), och den angivna avvikelsen där är större; se till att projektor och lins är rena och huden torr och matt, och flytta sensorn närmare.</translation>
        </message>
        <message>
            <source>None of the {count} pictures can be used: {reason}</source>
            <translation>Ingen av de {count} bilderna kan användas: {reason}</translation>
        </message>
        <message>
            <source>None was left out.</source>
            <translation>Ingen utelämnades.</translation>
        </message>
        <message>
            <source>None were recorded.</source>
            <translation>Inga spelades in.</translation>
        </message>
        <message>
            <source>Noridian A5513: base of diabetic insoles at least 4.8</source>
            <translation>Noridian A5513: basen i inlägg för diabetiker minst 4,8</translation>
        </message>
        <message>
            <source>Not exported</source>
            <translation>Inte exporterat</translation>
        </message>
        <message>
            <source>Not measured: {regions}; no view that is used shows it.</source>
            <translation>Inte mätt: {regions}; ingen vy som används visar det.</translation>
        </message>
        <message>
            <source>Notes</source>
            <translation>Anteckningar</translation>
        </message>
        <message>
            <source>Nothing can be told of the heads together, so of none of them alone.</source>
            <translation>Inget kan sägas om huvudena tillsammans, och därför inte om något av dem för sig.</translation>
        </message>
        <message>
            <source>Nothing can be written there, so neither settings nor work are kept: ask whoever looks after this computer for the right to write.</source>
            <translation>Ingenting kan skrivas där, så varken inställningar eller arbete sparas: be den som sköter datorn om rätt att skriva.</translation>
        </message>
        <message>
            <source>Nothing is kept of sensor {serial} that could be undone; check the serial number.</source>
            <translation>Det finns inget om sensor {serial} att ångra; kontrollera serienumret.</translation>
        </message>
        <message>
            <source>Nothing is known of the material “{material}”: the insole is made at least {least_mm:g} mm thick, {edge_mm:g} mm at the front edge; choose one of {names}.</source>
            <translation>Inget är känt om materialet ”{material}”: inlägget görs minst {least_mm:g} mm tjockt, {edge_mm:g} mm vid framkanten; välj ett av {names}.</translation>
        </message>
        <message>
            <source>Nothing links {groups}: each was measured on its own, and their place to each other stays as planned.</source>
            <translation>Inget förbinder {groups}: var och en mättes för sig, och deras läge till varandra förblir som planerat.</translation>
        </message>
        <message>
            <source>Nothing of the insole lies in the shoe "{shoe}"; choose the right shoe.</source>
            <translation>Inget av inlägget ligger i skon ”{shoe}”; välj rätt sko.</translation>
        </message>
        <message>
            <source>Nothing pressed there before.</source>
            <translation>Inget tryckte där förut.</translation>
        </message>
        <message>
            <source>Nothing was saved, because sensor {serial} could not be read again with this result; check what was given to the step and take it again: {reason}</source>
            <translation>Inget sparades, eftersom sensor {serial} inte skulle gå att läsa igen med detta resultat; kontrollera vad steget fick och gör om det: {reason}</translation>
        </message>
        <message>
            <source>Nothing was written to {place}: its disk is full, or takes no more from you; free some space and try again.</source>
            <translation>Inget skrevs till {place}: dess disk är full eller tar inte emot mer från dig; frigör utrymme och försök igen.</translation>
        </message>
        <message>
            <source>Number of pieces</source>
            <translation>Antal stycken</translation>
        </message>
        <message>
            <source>Occupation</source>
            <translation>Yrke</translation>
        </message>
        <message>
            <source>Once for all blocks of these sides: put in cutter {cutter}, set the zero as for the block, but z = 0 on the surface of the spoil board, and run {file}: it bores two holes of {diameter} mm, {depth} mm deep.</source>
            <translation>En gång för alla block med dessa mått: sätt i fräs {cutter}, ställ nollpunkten som för blocket men z = 0 på offerskivans yta, och kör {file}: det borrar två hål på {diameter} mm, {depth} mm djupa.</translation>
        </message>
        <message>
            <source>One column holds the whole name, and another a part of it; choose either the whole name, or given name and family name.</source>
            <translation>En kolumn innehåller hela namnet och en annan en del av det; välj antingen hela namnet eller förnamn och efternamn.</translation>
        </message>
        <message>
            <source>One end of the imprint is only {depth_mm:.0f} mm deep: heel or toes were hardly pressed in, so that side and length are uncertain; say which foot it is, and compare its length.</source>
            <translation>Ena änden av avtrycket är bara {depth_mm:.0f} mm djup: häl eller tår trycktes knappt ner, så sida och längd är osäkra; ange vilken fot det är och jämför dess längd.</translation>
        </message>
        <message>
            <source>One file is missing or damaged in the record and is not in the backup; verify the record, and restore it from an earlier backup.</source>
            <translation>En fil saknas eller är skadad i journalen och finns inte i säkerhetskopian; kontrollera journalen och återställ den från en tidigare säkerhetskopia.</translation>
        </message>
        <message>
            <source>One file of the record is missing: {first}; restore it from a backup.</source>
            <translation>En av journalens filer saknas: {first}; återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One file of the settings was there already, and stays.</source>
            <translation>En fil med inställningar fanns redan och står kvar.</translation>
        </message>
        <message>
            <source>One file was changed since the record stored it: {first}; restore it from a backup.</source>
            <translation>En fil har ändrats sedan journalen sparade den: {first}; återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One file was lost before it was made, and is not in it.</source>
            <translation>En fil hade förlorats innan den gjordes och finns inte i den.</translation>
        </message>
        <message>
            <source>One foot is put back; leave out the seed of the foot, or the others.</source>
            <translation>En fot läggs tillbaka; utelämna fotens frö eller det andra.</translation>
        </message>
        <message>
            <source>One patient was erased after the backup, and now again.</source>
            <translation>En patient raderades efter säkerhetskopian och nu igen.</translation>
        </message>
        <message>
            <source>One point far from all others was left out.</source>
            <translation>En punkt långt från alla andra har utelämnats.</translation>
        </message>
        <message>
            <source>One point stuck out of the surface as a spike and was drawn back.</source>
            <translation>En punkt stack ut ur ytan som en tagg och har dragits tillbaka.</translation>
        </message>
        <message>
            <source>One point was left out that lies close beside another.</source>
            <translation>En punkt som ligger tätt intill en annan utelämnades.</translation>
        </message>
        <message>
            <source>One row of {kind} is gone that the audit log knows: {first}; compare the record with a backup.</source>
            <translation>En rad av slaget {kind} som loggen känner till är borta: {first}; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One row of {kind} is in no line of the audit log: {first}; compare the record with a backup.</source>
            <translation>En rad av slaget {kind} finns inte i någon rad i loggen: {first}; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One row of {kind} is not what the audit log says was stored: {first}; compare it with a backup.</source>
            <translation>En rad av slaget {kind} är inte vad loggen säger att den var: {first}; jämför den med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One row of {table} refers to something that is not there; restore the record from a backup.</source>
            <translation>En rad i {table} hänvisar till något som inte finns; återställ journalen från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One signed prescription has a signature that the audit log does not know: {first}; compare it with a backup.</source>
            <translation>En signerad ordination har en signatur som loggen inte känner till: {first}; jämför den med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One signed prescription is gone: {first}; compare the record with a backup.</source>
            <translation>En signerad ordination är borta: {first}; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One signed prescription is not what was signed: {first}; compare it with a backup.</source>
            <translation>En signerad ordination är inte vad som signerades: {first}; jämför den med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>One view without a reference system: taken as a thing on a table.</source>
            <translation>En vy utan referenssystem: tas som ett föremål på ett bord.</translation>
        </message>
        <message>
            <source>Only a .3mf file holds zones and settings for a slicer, and {path} is none; change its suffix, or name no printer.</source>
            <translation>Bara en .3mf-fil rymmer zoner och inställningar för ett skivningsprogram, och {path} är ingen; ändra ändelsen, eller ange ingen skrivare.</translation>
        </message>
        <message>
            <source>Only a 3MF holds zones and settings for a slicer; choose 3MF as the format, or no printer.</source>
            <translation>Bara en 3MF rymmer zoner och inställningar för ett skivningsprogram; välj 3MF som format, eller ingen skrivare.</translation>
        </message>
        <message>
            <source>Only partly measured: {regions}; see the holes there before designing.</source>
            <translation>Bara delvis mätt: {regions}; se hålen där före design.</translation>
        </message>
        <message>
            <source>Only {count} pictures of the board can be used, but at least {least} are needed and {good} are good; take more, with the board tilted differently.</source>
            <translation>Bara {count} bilder av brädet kan användas, men minst {least} behövs och {good} är bra; ta fler, med brädet lutat på olika sätt.</translation>
        </message>
        <message>
            <source>Only {count} pictures were used; {good} or more are better.</source>
            <translation>Bara {count} bilder användes; {good} eller fler är bättre.</translation>
        </message>
        <message>
            <source>Only {count} points of {capture} lie on the object and away from what holds it; put it in the middle of the volume, on a smaller holder.</source>
            <translation>Bara {count} punkter av {capture} ligger på föremålet och ett stycke från det som håller det; lägg det mitt i volymen, på en mindre hållare.</translation>
        </message>
        <message>
            <source>Only {count} points were measured in the volume of interest, too few to find the object; put it in the middle of the volume, where the sensors see it.</source>
            <translation>Bara {count} punkter mättes i mätvolymen, för få för att hitta föremålet; lägg det mitt i volymen, där sensorerna ser det.</translation>
        </message>
        <message>
            <source>Only {count} walls can be used, but the pattern needs {least} or more at different distances; capture more flat walls. {reasons}</source>
            <translation>Bara {count} väggar kan användas, men mönstret behöver {least} eller fler på olika avstånd; ta upp fler plana väggar. {reasons}</translation>
        </message>
        <message>
            <source>Only {count} walls were used; six distances or more are better.</source>
            <translation>Bara {count} väggar användes; sex avstånd eller fler är bättre.</translation>
        </message>
        <message>
            <source>Only {left_mm:.1f} mm of material would be left at x = {x_mm:.0f} mm, y = {y_mm:.0f} mm, and {least_mm:g} mm are needed; the surface is raised there. Raise the thickness, or make the recess shallower.</source>
            <translation>Bara {left_mm:.1f} mm material skulle bli kvar vid x = {x_mm:.0f} mm, y = {y_mm:.0f} mm, och {least_mm:g} mm behövs; ytan höjs där. Öka tjockleken, eller gör urtaget grundare.</translation>
        </message>
        <message>
            <source>Only {share:.0%} of the pattern was seen on {least} walls or more, but at least {needed:.0%} must be; let the walls fill the picture.</source>
            <translation>Bara {share:.0%} av mönstret syntes på {least} väggar eller fler, men minst {needed:.0%} måste göra det; låt väggarna fylla bilden.</translation>
        </message>
        <message>
            <source>Only {share:.0%} of the {pad} lies below the foot; move it inwards.</source>
            <translation>Bara {share:.0%} av elementet ({pad}) ligger under foten; flytta det inåt.</translation>
        </message>
        <message>
            <source>Only {share:.0%} of the {pad} lies on the insole, and the rest is not made; set the shoe size or a longer outline.</source>
            <translation>Bara {share:.0%} av elementet ({pad}) ligger på inlägget, och resten blir inte gjord; ange skostorleken eller en längre kontur.</translation>
        </message>
        <message>
            <source>OpenGL {version}, {renderer}</source>
            <translation>OpenGL {version}, {renderer}</translation>
        </message>
        <message>
            <source>Order and machine</source>
            <translation>Beställning och maskin</translation>
        </message>
        <message>
            <source>Order number</source>
            <translation>Beställningsnummer</translation>
        </message>
        <message>
            <source>Order {number} has no solids and does not lie here; export it, and nest it with the next ones.</source>
            <translation>Beställningen {number} har inga solider och ligger inte här; exportera den och lägg den bland nästa.</translation>
        </message>
        <message>
            <source>Order {number} is among them twice; name its last revision alone.</source>
            <translation>Beställning {number} är med två gånger; ange bara dess senaste revision.</translation>
        </message>
        <message>
            <source>Order {number} was written without solids; export it again.</source>
            <translation>Beställning {number} skrevs utan stycken; exportera den på nytt.</translation>
        </message>
        <message>
            <source>Order {number}: 1 file that may name the patient</source>
            <translation>Beställning {number}: 1 fil som kan nämna patienten</translation>
        </message>
        <message>
            <source>Order {number}: {count} files that may name the patient</source>
            <translation>Beställning {number}: {count} filer som kan nämna patienten</translation>
        </message>
        <message>
            <source>Orders</source>
            <translation>Beställningar</translation>
        </message>
        <message>
            <source>Outcome</source>
            <translation>Resultat</translation>
        </message>
        <message>
            <source>Outline</source>
            <translation>Kontur</translation>
        </message>
        <message>
            <source>Oval pad</source>
            <translation>Oval pelott</translation>
        </message>
        <message>
            <source>Over</source>
            <translation>Över</translation>
        </message>
        <message>
            <source>Overload of the 1st metatarsal head</source>
            <translation>Överbelastat 1:a metatarsalhuvud</translation>
        </message>
        <message>
            <source>Overload of the 2nd metatarsal head</source>
            <translation>Överbelastat 2:a metatarsalhuvud</translation>
        </message>
        <message>
            <source>Overload of the 3rd metatarsal head</source>
            <translation>Överbelastat 3:e metatarsalhuvud</translation>
        </message>
        <message>
            <source>Overload of the 4th metatarsal head</source>
            <translation>Överbelastat 4:e metatarsalhuvud</translation>
        </message>
        <message>
            <source>Overload of the 5th metatarsal head</source>
            <translation>Överbelastat 5:e metatarsalhuvud</translation>
        </message>
        <message>
            <source>PA12, printed</source>
            <translation>PA12, utskriven</translation>
        </message>
        <message>
            <source>PTTD</source>
            <translation>PTTD</translation>
        </message>
        <message>
            <source>Pad of 2 to 4.</source>
            <translation>Pelott på 2 till 4.</translation>
        </message>
        <message>
            <source>Pain at the base of the 5th metatarsal</source>
            <translation>Smärta vid 5:e metatarsalens bas</translation>
        </message>
        <message>
            <source>Paris points of 6.67 mm, with 15 mm before the toes</source>
            <translation>parispunkter om 6,67 mm, med 15 mm framför tårna</translation>
        </message>
        <message>
            <source>Path</source>
            <translation>Väg</translation>
        </message>
        <message>
            <source>Pattern of dots</source>
            <translation>Punktmönster</translation>
        </message>
        <message>
            <source>Pelott</source>
            <translation>Pelott</translation>
        </message>
        <message>
            <source>Permission for sensors</source>
            <translation>Behörighet till sensorer</translation>
        </message>
        <message>
            <source>Person</source>
            <translation>Person</translation>
        </message>
        <message>
            <source>Personal number</source>
            <translation>Personnummer</translation>
        </message>
        <message>
            <source>Photo</source>
            <translation>Foto</translation>
        </message>
        <message>
            <source>Piece</source>
            <translation>Arbetsstycke</translation>
        </message>
        <message>
            <source>Place</source>
            <translation>Läge</translation>
        </message>
        <message>
            <source>Place, date, signature</source>
            <translation>Ort, datum, underskrift</translation>
        </message>
        <message>
            <source>Places are given in the frame of the file, which the page of the block shows. A red cross marks the worst place of a check that failed.</source>
            <translation>Lägen anges i filens koordinater, som sidan om blocket visar. Ett rött kryss visar det sämsta stället för en kontroll som inte klarades.</translation>
        </message>
        <message>
            <source>Places are given in the frame of the file: the origin is the corner of the block at the lower left of the drawing, x runs to the right along its width, y upwards along its length, z = 0 is its bottom. A red cross marks the worst place of a check that failed.</source>
            <translation>Lägen anges i filens koordinater: origo är blockets hörn nere till vänster i ritningen, x går åt höger längs bredden, y uppåt längs längden, och z = 0 är undersidan. Ett rött kryss visar det sämsta stället för en kontroll som inte klarades.</translation>
        </message>
        <message>
            <source>Places are given in the frame of the file: y runs from heel to toes, x = 0 is the foot's axis, z = 0 the plane that the piece stands on. A red cross marks the worst place of a check that failed.</source>
            <translation>Lägen anges i filens koordinater: y går från häl till tår, x = 0 är fotens axel och z = 0 planet som arbetsstycket står på. Ett rött kryss visar det sämsta stället för en kontroll som inte klarades.</translation>
        </message>
        <message>
            <source>Places of a drawn edge</source>
            <translation>Platser på en ritad kant</translation>
        </message>
        <message>
            <source>Places of the pointer along the stroke</source>
            <translation>Pekarens platser längs draget</translation>
        </message>
        <message>
            <source>Placing the view {view}</source>
            <translation>Placerar vyn {view}</translation>
        </message>
        <message>
            <source>Plantar fasciitis</source>
            <translation>Plantar fasciit</translation>
        </message>
        <message>
            <source>Plantar fasciitis with forefoot valgus</source>
            <translation>Plantar fasciit med framfotsvalgus</translation>
        </message>
        <message>
            <source>Plantarflexed first ray</source>
            <translation>Plantarflekterad första stråle</translation>
        </message>
        <message>
            <source>Podiatry Today; ProLab, hallux limitus</source>
            <translation>Podiatry Today; ProLab, hallux limitus</translation>
        </message>
        <message>
            <source>Point {number} of the trim line, counted from the medial side, lies beside the insole; move it onto the insole.</source>
            <translation>Punkt {number} på klipplinjen, räknad från medialsidan, ligger bredvid inlägget; flytta in den på inlägget.</translation>
        </message>
        <message>
            <source>Posting</source>
            <translation>Kilning</translation>
        </message>
        <message>
            <source>Posts, pads and corrections</source>
            <translation>Stöd, pelotter och korrigeringar</translation>
        </message>
        <message>
            <source>Prescribed thickness</source>
            <translation>Ordinerad tjocklek</translation>
        </message>
        <message>
            <source>Prescriber</source>
            <translation>Ordinatör</translation>
        </message>
        <message>
            <source>Prescriber and maker</source>
            <translation>Ordinatör och tillverkare</translation>
        </message>
        <message>
            <source>Prescription of a custom-made insole</source>
            <translation>Ordination av ett specialanpassat inlägg</translation>
        </message>
        <message>
            <source>Pressure under the 1st toe</source>
            <translation>Tryck under 1:a tån</translation>
        </message>
        <message>
            <source>Pressure under the 2nd toe</source>
            <translation>Tryck under 2:a tån</translation>
        </message>
        <message>
            <source>Pressure under the 3rd toe</source>
            <translation>Tryck under 3:e tån</translation>
        </message>
        <message>
            <source>Pressure under the 4th toe</source>
            <translation>Tryck under 4:e tån</translation>
        </message>
        <message>
            <source>Pressure under the 5th toe</source>
            <translation>Tryck under 5:e tån</translation>
        </message>
        <message>
            <source>ProLab, pediatric</source>
            <translation>ProLab, barn</translation>
        </message>
        <message>
            <source>ProLab, plantar fasciitis</source>
            <translation>ProLab, plantarfasciit</translation>
        </message>
        <message>
            <source>ProLab, tibialis posterior; footankle.com, flat foot</source>
            <translation>ProLab, tibialis posterior; footankle.com, plattfot</translation>
        </message>
        <message>
            <source>Program</source>
            <translation>Program</translation>
        </message>
        <message>
            <source>Programs, in the order in which they are run</source>
            <translation>Program, i den ordning de körs</translation>
        </message>
        <message>
            <source>Projection</source>
            <translation>Projektion</translation>
        </message>
        <message>
            <source>Pseudonym</source>
            <translation>Pseudonym</translation>
        </message>
        <message>
            <source>Pseudonym or order number</source>
            <translation>Pseudonym eller beställningsnummer</translation>
        </message>
        <message>
            <source>Put in cutter {cutter}, and run {file}.</source>
            <translation>Sätt i fräs {cutter} och kör {file}.</translation>
        </message>
        <message>
            <source>Put the dowels into the board, turn the block about {line}, foot side down, and lay it on them; the zero stays.</source>
            <translation>Sätt styrpinnarna i skivan, vänd blocket runt {line}, fotsidan ned, och lägg det på dem; nollpunkten står kvar.</translation>
        </message>
        <message>
            <source>Put the sensor in its place for view {views}</source>
            <translation>Ställ sensorn på sin plats för vy {views}</translation>
        </message>
        <message>
            <source>Quantity</source>
            <translation>Antal</translation>
        </message>
        <message>
            <source>Radius</source>
            <translation>Radie</translation>
        </message>
        <message>
            <source>Raise heel and ball together, for legs of unequal length</source>
            <translation>Höj häl och trampdyna tillsammans, för ben av olika längd</translation>
        </message>
        <message>
            <source>Raise the medial arch about its apex</source>
            <translation>Höj det mediala fotvalvet kring dess högsta punkt</translation>
        </message>
        <message>
            <source>Raise the pad</source>
            <translation>Höj pelotten</translation>
        </message>
        <message>
            <source>Raise the whole heel</source>
            <translation>Höj hela hälen</translation>
        </message>
        <message>
            <source>Read in {unit}.</source>
            <translation>Inläst i {unit}.</translation>
        </message>
        <message>
            <source>Reading the depth of the boards</source>
            <translation>Läser brädenas djup</translation>
        </message>
        <message>
            <source>Reading the scan</source>
            <translation>Läser skanningen</translation>
        </message>
        <message>
            <source>Reading the session</source>
            <translation>Läser sessionen</translation>
        </message>
        <message>
            <source>Reading version {number}</source>
            <translation>Version {number} läses</translation>
        </message>
        <message>
            <source>Reading {file}</source>
            <translation>Läser {file}</translation>
        </message>
        <message>
            <source>Reading {name}</source>
            <translation>Läser {name}</translation>
        </message>
        <message>
            <source>Rearfoot</source>
            <translation>Bakfot</translation>
        </message>
        <message>
            <source>Rearfoot angle: calcaneus to Achilles tendon</source>
            <translation>Bakfotsvinkel: hälben mot akillessena</translation>
        </message>
        <message>
            <source>Rearfoot post</source>
            <translation>Bakfotskil</translation>
        </message>
        <message>
            <source>Rearfoot up to</source>
            <translation>Bakfot till</translation>
        </message>
        <message>
            <source>Reason</source>
            <translation>Orsak</translation>
        </message>
        <message>
            <source>Record</source>
            <translation>Journal</translation>
        </message>
        <message>
            <source>Record of a patient</source>
            <translation>Utdrag ur en patients journal</translation>
        </message>
        <message>
            <source>Recorded</source>
            <translation>Avbildad</translation>
        </message>
        <message>
            <source>Reducing the triangles</source>
            <translation>Minskar trianglarna</translation>
        </message>
        <message>
            <source>Refining the surface</source>
            <translation>Förfinar ytan</translation>
        </message>
        <message>
            <source>Region</source>
            <translation>Område</translation>
        </message>
        <message>
            <source>Released against a blocking rule by {author}, {at}: {reason}</source>
            <translation>Frisläppt trots en spärrande regel av {author}, {at}: {reason}</translation>
        </message>
        <message>
            <source>Released by</source>
            <translation>Frisläppt av</translation>
        </message>
        <message>
            <source>Relief at the base of the 5th metatarsal</source>
            <translation>Avlastning vid femte metatarsalbenets bas</translation>
        </message>
        <message>
            <source>Relief under the 1st head</source>
            <translation>Avlastning under första huvudet</translation>
        </message>
        <message>
            <source>Relief under the 1st toe</source>
            <translation>Avlastning under första tån</translation>
        </message>
        <message>
            <source>Relief under the 2nd head</source>
            <translation>Avlastning under andra huvudet</translation>
        </message>
        <message>
            <source>Relief under the 2nd toe</source>
            <translation>Avlastning under andra tån</translation>
        </message>
        <message>
            <source>Relief under the 3rd head</source>
            <translation>Avlastning under tredje huvudet</translation>
        </message>
        <message>
            <source>Relief under the 3rd toe</source>
            <translation>Avlastning under tredje tån</translation>
        </message>
        <message>
            <source>Relief under the 4th head</source>
            <translation>Avlastning under fjärde huvudet</translation>
        </message>
        <message>
            <source>Relief under the 4th toe</source>
            <translation>Avlastning under fjärde tån</translation>
        </message>
        <message>
            <source>Relief under the 5th head</source>
            <translation>Avlastning under femte huvudet</translation>
        </message>
        <message>
            <source>Relief under the 5th toe</source>
            <translation>Avlastning under femte tån</translation>
        </message>
        <message>
            <source>Remarks</source>
            <translation>Anmärkningar</translation>
        </message>
        <message>
            <source>Removed: {correction}</source>
            <translation>Borttaget: {correction}</translation>
        </message>
        <message>
            <source>Residuals of the calibration</source>
            <translation>Kalibreringens restfel</translation>
        </message>
        <message>
            <source>Restoring files ({done} of {all})</source>
            <translation>Återställer filer ({done} av {all})</translation>
        </message>
        <message>
            <source>Restoring the table {table}</source>
            <translation>Återställer tabellen {table}</translation>
        </message>
        <message>
            <source>Reverse Morton's extension</source>
            <translation>Omvänd Mortons förlängning</translation>
        </message>
        <message>
            <source>Revision</source>
            <translation>Revision</translation>
        </message>
        <message>
            <source>Right insole</source>
            <translation>Höger inlägg</translation>
        </message>
        <message>
            <source>Rocker</source>
            <translation>Rullsula</translation>
        </message>
        <message>
            <source>Room</source>
            <translation>Spelrum</translation>
        </message>
        <message>
            <source>Root</source>
            <translation>Root</translation>
        </message>
        <message>
            <source>Roughing, level {level} of {levels}</source>
            <translation>Grovfräser, nivå {level} av {levels}</translation>
        </message>
        <message>
            <source>Round the piece there is {over:.1f} mm too little of the block for the cutter "{cutter}"; take a larger block, or a thinner cutter for the contour.</source>
            <translation>Runt stycket har blocket {over:.1f} mm för lite för fräsen ”{cutter}”; ta ett större block eller en tunnare fräs för konturen.</translation>
        </message>
        <message>
            <source>Rounding a steep rim takes up to {lowered_mm:.1f} mm off its height, most at x = {x_mm:.0f} mm, y = {y_mm:.0f} mm; design the rim higher by as much, or make the edge radius smaller, if its height counts.</source>
            <translation>Rundningen av en brant rand tar upp till {lowered_mm:.1f} mm av dess höjd, mest vid x = {x_mm:.0f} mm, y = {y_mm:.0f} mm; gör randen lika mycket högre, eller kantradien mindre, om höjden är viktig.</translation>
        </message>
        <message>
            <source>Rounding of the post's lower edge</source>
            <translation>Avrundning av kilens nedre kant</translation>
        </message>
        <message>
            <source>Rounding of the upper edge</source>
            <translation>Avrundning av den övre kanten</translation>
        </message>
        <message>
            <source>SHA-256</source>
            <translation>SHA-256</translation>
        </message>
        <message>
            <source>SHA-256 of the foot</source>
            <translation>Fotens SHA-256</translation>
        </message>
        <message>
            <source>SHA-256 of the scan</source>
            <translation>Skanningens SHA-256</translation>
        </message>
        <message>
            <source>Sampling the surface</source>
            <translation>Läser av ytan</translation>
        </message>
        <message>
            <source>Scale</source>
            <translation>Skala</translation>
        </message>
        <message>
            <source>Scaled by the size that is known.</source>
            <translation>Skalad efter det kända måttet.</translation>
        </message>
        <message>
            <source>Scan</source>
            <translation>Skanning</translation>
        </message>
        <message>
            <source>Seen from behind, angles twice as large. Blue: Achilles tendon; brown: calcaneus; grey: normal of the sole (dashed), upright of the scan (dotted). An angle is 0 where its two lines are one. Valgus: the heel tilts to the outside under the leg; medial: the leg leans to the other foot. In files, valgus and medial are above 0; of the forefoot, varus is.</source>
            <translation>Sett bakifrån, vinklar dubbelt så stora. Blått: akillessena; brunt: hälben; grått: fotsulans normal (streckad), skanningens lodlinje (prickad). En vinkel är 0 där dess två linjer är en. Valgus: hälen lutar utåt under benet; medial: benet lutar mot den andra foten. I filer är valgus och medial över 0; för framfoten är varus det.</translation>
        </message>
        <message>
            <source>Sensor {serial} is a {model}, but what is stored under its number was calibrated for a {stored} with other depth pictures; undo that calibration, then calibrate the sensor.</source>
            <translation>Sensorn {serial} är en {model}, men det som finns sparat under dess nummer kalibrerades för en {stored} med andra djupbilder; ångra den kalibreringen och kalibrera sedan sensorn.</translation>
        </message>
        <message>
            <source>Sensor {serial} is a {model}, which measures no disparity that walls could correct; use it as its factory calibrated it.</source>
            <translation>Sensorn {serial} är en {model}, som inte mäter någon disparitet som väggar kan korrigera; använd den som fabriken kalibrerade den.</translation>
        </message>
        <message>
            <source>Sensor {serial} is a {model}, whose cameras and scale its factory has calibrated; calibrate only the distortion of its depth, with walls.</source>
            <translation>Sensorn {serial} är en {model}, vars kameror och skala fabriken har kalibrerat; kalibrera bara djupets distorsion, med väggar.</translation>
        </message>
        <message>
            <source>Sensor {serial} is not calibrated; the numbers of its factory are used, which are several millimetres less exact.</source>
            <translation>Sensor {serial} är inte kalibrerad; fabrikens värden används, vilka är flera millimeter mindre noggranna.</translation>
        </message>
        <message>
            <source>Sensor {serial} is not in use; look for sensors again.</source>
            <translation>Sensor {serial} används inte; sök efter sensorer igen.</translation>
        </message>
        <message>
            <source>Sensor {serial} is not in use; plug it in.</source>
            <translation>Sensor {serial} används inte; anslut den.</translation>
        </message>
        <message>
            <source>Sensor {serial} is used as its factory calibrated it, with waves of some tenths of a millimetre on flat surfaces; calibrate the distortion of its depth with walls.</source>
            <translation>Sensorn {serial} används som fabriken kalibrerade den, med vågor på några tiondels millimeter på plana ytor; kalibrera djupets distorsion med väggar.</translation>
        </message>
        <message>
            <source>Sensor {serial} leans to one side by {roll_deg:.0f}°, which its motor cannot mend; straighten it by hand and level it again.</source>
            <translation>Sensor {serial} lutar {roll_deg:.0f}° åt sidan, vilket dess motor inte kan rätta; räta upp den för hand och ställ den vågrätt igen.</translation>
        </message>
        <message>
            <source>Sensor {serial} was never calibrated here, so its pattern of dots cannot be kept; calibrate it first, or write the pattern by --out.</source>
            <translation>Sensor {serial} har aldrig kalibrerats här, så dess punktmönster kan inte sparas; kalibrera den först, eller skriv mönstret med --out.</translation>
        </message>
        <message>
            <source>Sensor {serial} {lacks}.</source>
            <translation>Sensor {serial} {lacks}.</translation>
        </message>
        <message>
            <source>Sensors</source>
            <translation>Sensorer</translation>
        </message>
        <message>
            <source>Serial number of the piece</source>
            <translation>Styckets serienummer</translation>
        </message>
        <message>
            <source>Sesamoiditis</source>
            <translation>Sesamoidit</translation>
        </message>
        <message>
            <source>Set the depth of the heel cup</source>
            <translation>Ange hälskålens djup</translation>
        </message>
        <message>
            <source>Set-up sheet for the router</source>
            <translation>Inställningsblad för fräsmaskinen</translation>
        </message>
        <message>
            <source>Settings</source>
            <translation>Inställningar</translation>
        </message>
        <message>
            <source>Shape</source>
            <translation>Form</translation>
        </message>
        <message>
            <source>Shaping the foot</source>
            <translation>Formar foten</translation>
        </message>
        <message>
            <source>Share of the foot</source>
            <translation>Fotens andel</translation>
        </message>
        <message>
            <source>Share of the foot's length at which the cup ends</source>
            <translation>Andel av fotens längd där skålen slutar</translation>
        </message>
        <message>
            <source>Share of the foot's length at which the lift ends</source>
            <translation>Andel av fotens längd där höjningen slutar</translation>
        </message>
        <message>
            <source>Share of the foot's length at which the twist begins</source>
            <translation>Andel av fotens längd där vridningen börjar</translation>
        </message>
        <message>
            <source>Share of the foot's length from which the forefoot angle holds</source>
            <translation>Andel av fotens längd från vilken framfotens vinkel gäller</translation>
        </message>
        <message>
            <source>Share of the foot's length from which the whole angle holds</source>
            <translation>Andel av fotens längd från vilken hela vinkeln gäller</translation>
        </message>
        <message>
            <source>Share of the foot's length up to which the cup has its full depth</source>
            <translation>Andel av fotens längd upp till vilken skålen har fullt djup</translation>
        </message>
        <message>
            <source>Share of the foot's length up to which the heel is raised in full</source>
            <translation>Andel av fotens längd upp till vilken hälen är helt höjd</translation>
        </message>
        <message>
            <source>Share of the foot's length up to which the rearfoot angle holds</source>
            <translation>Andel av fotens längd upp till vilken bakfotens vinkel gäller</translation>
        </message>
        <message>
            <source>Share of the pattern covered</source>
            <translation>Täckt del av mönstret</translation>
        </message>
        <message>
            <source>Sheet</source>
            <translation>Blad</translation>
        </message>
        <message>
            <source>Shell</source>
            <translation>Skal</translation>
        </message>
        <message>
            <source>Shoe</source>
            <translation>Sko</translation>
        </message>
        <message>
            <source>Shoe size</source>
            <translation>Skostorlek</translation>
        </message>
        <message>
            <source>Shoe size EU</source>
            <translation>Skostorlek EU</translation>
        </message>
        <message>
            <source>Shop</source>
            <translation>Verkstad</translation>
        </message>
        <message>
            <source>Side</source>
            <translation>Sida</translation>
        </message>
        <message>
            <source>Side height</source>
            <translation>Sidohöjd</translation>
        </message>
        <message>
            <source>Signature</source>
            <translation>Signatur</translation>
        </message>
        <message>
            <source>Signed by</source>
            <translation>Signerad av</translation>
        </message>
        <message>
            <source>Simulating view {name}</source>
            <translation>Simulerar vyn {name}</translation>
        </message>
        <message>
            <source>Simulating walls before sensor {serial}</source>
            <translation>Simulerar väggar framför sensor {serial}</translation>
        </message>
        <message>
            <source>Size of the shoe</source>
            <translation>Skons storlek</translation>
        </message>
        <message>
            <source>Size of the shoe, which decides the length</source>
            <translation>Skons storlek, som bestämmer längden</translation>
        </message>
        <message>
            <source>Skin smoothing</source>
            <translation>Hudutjämning</translation>
        </message>
        <message>
            <source>Slope</source>
            <translation>Lutning</translation>
        </message>
        <message>
            <source>Slope of the underside ahead of the line</source>
            <translation>Undersidans lutning framför linjen</translation>
        </message>
        <message>
            <source>Slope of the wedge against the ground</source>
            <translation>Kilens lutning mot underlaget</translation>
        </message>
        <message>
            <source>Soft tissue expansion</source>
            <translation>Mjukdelstillägg</translation>
        </message>
        <message>
            <source>Solving again without uneven walls</source>
            <translation>Löser igen utan ojämna väggar</translation>
        </message>
        <message>
            <source>Solving the distortion map</source>
            <translation>Löser distorsionskartan</translation>
        </message>
        <message>
            <source>Some dates can be read in two ways; say whether the day or the month comes first.</source>
            <translation>Vissa datum kan läsas på två sätt; ange om dagen eller månaden kommer först.</translation>
        </message>
        <message>
            <source>Somebody else has changed the fields of this person meanwhile; choose which to keep.</source>
            <translation>Någon annan har under tiden ändrat den här personens fält; välj vilka som ska behållas.</translation>
        </message>
        <message>
            <source>Somebody else has changed the fields of this visit meanwhile; choose which to keep.</source>
            <translation>Någon annan har under tiden ändrat det här besökets fält; välj vilka som ska behållas.</translation>
        </message>
        <message>
            <source>Somebody else has changed the order {number} meanwhile; look at it again.</source>
            <translation>Någon annan har under tiden ändrat beställningen {number}; titta på den igen.</translation>
        </message>
        <message>
            <source>Somebody else has drawn on this photo meanwhile; look at it again.</source>
            <translation>Någon annan har ritat på fotot under tiden; titta på det igen.</translation>
        </message>
        <message>
            <source>Something moved between depth and infrared of view {view}, so its infrared pictures are left out and the sensor's own depth is used; hold the foot still and capture this view again.</source>
            <translation>Något rörde sig mellan djup och infrarött i vyn {view}, så dess infraröda bilder utelämnas och sensorns eget djup används; håll foten stilla och ta vyn igen.</translation>
        </message>
        <message>
            <source>Something moved while view {view} was captured; hold the foot still and capture this view again.</source>
            <translation>Något rörde sig medan vyn {view} togs; håll foten stilla och ta vyn igen.</translation>
        </message>
        <message>
            <source>Sore spot under the heel</source>
            <translation>Öm punkt under hälen</translation>
        </message>
        <message>
            <source>Splayfoot</source>
            <translation>Spridd framfot</translation>
        </message>
        <message>
            <source>Sport, full length</source>
            <translation>Sport, hel längd</translation>
        </message>
        <message>
            <source>Statement for a custom-made device (Regulation (EU) 2017/745, Annex XIII)</source>
            <translation>Försäkran om en specialanpassad produkt (förordning (EU) 2017/745, bilaga XIII)</translation>
        </message>
        <message>
            <source>Strength</source>
            <translation>Styrka</translation>
        </message>
        <message>
            <source>Stretch the pad</source>
            <translation>Sträck pelotten</translation>
        </message>
        <message>
            <source>SureFit; orthoscan</source>
            <translation>SureFit; orthoscan</translation>
        </message>
        <message>
            <source>Swedish personal number</source>
            <translation>Svenskt personnummer</translation>
        </message>
        <message>
            <source>TPU, printed</source>
            <translation>TPU, utskriven</translation>
        </message>
        <message>
            <source>Tailor's bunion</source>
            <translation>Skräddarknuta</translation>
        </message>
        <message>
            <source>Take {count} more pictures, the board tilted by 20 to 40° to another side each time.</source>
            <translation>Ta {count} bilder till, med brädet lutat 20 till 40° åt ett nytt håll varje gång.</translation>
        </message>
        <message>
            <source>Take {count} more walls at other distances.</source>
            <translation>Ta {count} väggar till på andra avstånd.</translation>
        </message>
        <message>
            <source>Taking infrared pictures of view {views}</source>
            <translation>Tar infraröda bilder av vyn {views}</translation>
        </message>
        <message>
            <source>Taking the background away</source>
            <translation>Tar bort bakgrunden</translation>
        </message>
        <message>
            <source>Taper</source>
            <translation>Avsmalning</translation>
        </message>
        <message>
            <source>Taper length</source>
            <translation>Avsmalningens längd</translation>
        </message>
        <message>
            <source>Telfer/OpenFO (3.0); above 95 kg the clinic's own judgement</source>
            <translation>Telfer/OpenFO (3,0); över 95 kg klinikens egen bedömning</translation>
        </message>
        <message>
            <source>The "{name}" of the order must be one line of at most {most} characters; shorten it.</source>
            <translation>Beställningens ”{name}” måste vara en rad med högst {most} tecken; korta den.</translation>
        </message>
        <message>
            <source>The 1st metatarsal head lies lateral of the 5th on this {side} foot; exchange the two, or check the side.</source>
            <translation>Det 1:a metatarsalhuvudet ligger lateralt om det 5:e på denna {side} fot; byt dem, eller kontrollera sidan.</translation>
        </message>
        <message>
            <source>The 3-D views need OpenGL {version}: renew the driver of the graphics card, or start with the environment variable LIBGL_ALWAYS_SOFTWARE=1.</source>
            <translation>3D-vyerna behöver OpenGL {version}: förnya grafikkortets drivrutin, eller starta med miljövariabeln LIBGL_ALWAYS_SOFTWARE=1.</translation>
        </message>
        <message>
            <source>The account {account} ({role}) may not {action}; ask somebody who may: {who}.</source>
            <translation>Kontot {account} ({role}) får inte {action}; fråga någon som får: {who}.</translation>
        </message>
        <message>
            <source>The address holds a password, which would be stored with the settings; take it out, and type it into its own line.</source>
            <translation>Adressen innehåller ett lösenord, som skulle lagras med inställningarna; ta bort det och skriv det på sin egen rad.</translation>
        </message>
        <message>
            <source>The address of the database asks for {option}={found}, with which patients' data could be read on the way; remove it, or write {option}={value}.</source>
            <translation>Databasens adress begär {option}={found}, och då kan patientuppgifter läsas på vägen; ta bort det eller skriv {option}={value}.</translation>
        </message>
        <message>
            <source>The address of the database cannot be read; write it as postgresql+psycopg://user@server/database.</source>
            <translation>Databasens adress kan inte läsas; skriv den som postgresql+psycopg://user@server/database.</translation>
        </message>
        <message>
            <source>The address of the database does not say which one of the server; write it as postgresql+psycopg://user@server/database.</source>
            <translation>Databasens adress säger inte vilken av serverns databaser; skriv den som postgresql+psycopg://user@server/database.</translation>
        </message>
        <message>
            <source>The address of the database has the option {option}, which is not allowed, since it could lead to another server or weaken the connection; remove it.</source>
            <translation>Databasens adress har tillvalet {option}, som inte är tillåtet eftersom det kan leda till en annan server eller försvaga anslutningen; ta bort det.</translation>
        </message>
        <message>
            <source>The address of the database has the port {port}; give one from 1 to 65535.</source>
            <translation>Databasens adress har porten {port}; ange en från 1 till 65535.</translation>
        </message>
        <message>
            <source>The address of the database holds a password as {option}; remove it: the password is asked, or taken from PostgreSQL's own password file.</source>
            <translation>Databasens adress innehåller ett lösenord som {option}; ta bort det: lösenordet efterfrågas eller tas från PostgreSQL:s egen lösenordsfil.</translation>
        </message>
        <message>
            <source>The address of the database names a server that cannot be one, {server}; write its name, or for a socket of this computer: postgresql+psycopg://user@/database?host=/folder.</source>
            <translation>Databasens adress nämner en server som inte kan vara någon, {server}; skriv dess namn, eller för en socket på den här datorn: postgresql+psycopg://user@/database?host=/folder.</translation>
        </message>
        <message>
            <source>The address of the database names no server, and the environment variable {variable} would choose one; name the server in the address.</source>
            <translation>Databasens adress nämner ingen server, och miljövariabeln {variable} skulle välja en; ange servern i adressen.</translation>
        </message>
        <message>
            <source>The address of the database names this computer and others; name one or the other.</source>
            <translation>Databasens adress nämner både den här datorn och andra; ange det ena eller det andra.</translation>
        </message>
        <message>
            <source>The address of the database says {option} more than once; say it once.</source>
            <translation>Databasens adress anger {option} mer än en gång; ange det en gång.</translation>
        </message>
        <message>
            <source>The arch is only {height_mm:g} mm high where {target_mm:g} mm are prescribed; a recess or a stroke lowers it there.</source>
            <translation>Fotvalvet är bara {height_mm:g} mm högt där {target_mm:g} mm är ordinerat; ett urtag eller ett penseldrag sänker det där.</translation>
        </message>
        <message>
            <source>The arch is to be filled by {asked_mm:.1f} mm and is only {height_mm:.1f} mm high; it is filled by {height_mm:.1f} mm; set a smaller fill.</source>
            <translation>Fotvalvet ska fyllas ut med {asked_mm:.1f} mm och är bara {height_mm:.1f} mm högt; det fylls ut med {height_mm:.1f} mm; ställ in en mindre utfyllnad.</translation>
        </message>
        <message>
            <source>The arch is to be raised beside the insole; move its place inwards.</source>
            <translation>Fotvalvet ska höjas bredvid inlägget; flytta platsen inåt.</translation>
        </message>
        <message>
            <source>The arch is {height_mm:g} mm high where {target_mm:g} mm are prescribed, and an arch raise lowers nothing; prescribe a greater height, or lower the surface there.</source>
            <translation>Fotvalvet är {height_mm:g} mm högt där {target_mm:g} mm är ordinerat, och en höjning sänker ingenting; ordinera en större höjd, eller sänk ytan där.</translation>
        </message>
        <message>
            <source>The arrangement of the window is damaged, so it has its usual one.</source>
            <translation>Fönstrets uppställning är skadad, så det har den vanliga.</translation>
        </message>
        <message>
            <source>The audit log ends with line {last}, but one line was written; compare it with a backup.</source>
            <translation>Loggen slutar med rad {last}, men en rad har skrivits; jämför med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>The audit log ends with line {last}, but {count} lines were written; compare it with a backup.</source>
            <translation>Loggen slutar med rad {last}, men {count} rader har skrivits; jämför med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>The audit log has one line, and it is not noted beside the files any more, so that an end that was cut off would not be seen; compare the record with a backup. The next change notes it again.</source>
            <translation>Loggen har en rad, och den är inte längre noterad bredvid filerna, så att ett avklippt slut inte skulle synas; jämför journalen med en säkerhetskopia. Nästa ändring noterar den igen.</translation>
        </message>
        <message>
            <source>The audit log has {count} lines, and the last one is not noted beside the files any more, so that an end that was cut off would not be seen; compare the record with a backup. The next change notes it again.</source>
            <translation>Loggen har {count} rader, och den sista är inte längre noterad bredvid filerna, så att ett avklippt slut inte skulle synas; jämför journalen med en säkerhetskopia. Nästa ändring noterar den igen.</translation>
        </message>
        <message>
            <source>The backup in {folder} comes from a newer Insole Studio; install the newest version.</source>
            <translation>Säkerhetskopian i {folder} kommer från en nyare Insole Studio; installera den senaste versionen.</translation>
        </message>
        <message>
            <source>The backup is damaged: {name} is not what was written; use an earlier backup or another copy.</source>
            <translation>Säkerhetskopian är skadad: {name} är inte vad som skrevs; använd en tidigare säkerhetskopia eller ett annat exemplar.</translation>
        </message>
        <message>
            <source>The backup is incomplete: {name} is missing; use an earlier backup or another copy.</source>
            <translation>Säkerhetskopian är ofullständig: {name} saknas; använd en tidigare säkerhetskopia eller ett annat exemplar.</translation>
        </message>
        <message>
            <source>The backup {name} comes from a newer Insole Studio; install the newest version.</source>
            <translation>Säkerhetskopian {name} kommer från en nyare Insole Studio; installera den senaste versionen.</translation>
        </message>
        <message>
            <source>The ball is lifted by {height_mm:g} mm; on the device up to {usual_mm:g} mm are usual.</source>
            <translation>Trampdynan är höjd {height_mm:g} mm; på inlägget är upp till {usual_mm:g} mm vanligt.</translation>
        </message>
        <message>
            <source>The birth date {born} is not that of the personal number, {of_number}; correct one of them.</source>
            <translation>Födelsedatumet {born} är inte personnumrets, {of_number}; rätta ett av dem.</translation>
        </message>
        <message>
            <source>The block is {there:g} mm high, and the piece needs {need:.1f} mm in it; take a higher block.</source>
            <translation>Blocket är {there:g} mm högt, och stycket behöver {need:.1f} mm; ta ett högre block.</translation>
        </message>
        <message>
            <source>The block on the machine, seen from above</source>
            <translation>Blocket på maskinen, sett uppifrån</translation>
        </message>
        <message>
            <source>The block, seen from above</source>
            <translation>Blocket, sett ovanifrån</translation>
        </message>
        <message>
            <source>The board is seen by both cameras in {count} pairs of pictures, but {least} are needed; take infrared and colour pictures of the same positions.</source>
            <translation>Brädet syns för båda kamerorna i {count} bildpar, men {least} behövs; ta infraröda bilder och färgbilder av samma lägen.</translation>
        </message>
        <message>
            <source>The board is seen in colour and depth at {count} positions, but {least} are needed; hold it 600 to 1500 mm from the sensor and take more.</source>
            <translation>Brädet syns i färg och djup i {count} lägen, men {least} behövs; håll det 600 till 1500 mm från sensorn och ta fler.</translation>
        </message>
        <message>
            <source>The board was hardly seen in these parts: {parts}.</source>
            <translation>Brädet syntes knappt i dessa delar: {parts}.</translation>
        </message>
        <message>
            <source>The board was held the same way in all pictures; tilt it by 20 to 40 degrees to all sides and take more.</source>
            <translation>Brädet hölls likadant i alla bilder; luta det 20 till 40 grader åt alla håll och ta fler.</translation>
        </message>
        <message>
            <source>The board would have stood {distance_mm:.0f} mm from the camera; check the size of its square, which must be given in millimetres.</source>
            <translation>Brädet skulle ha stått {distance_mm:.0f} mm från kameran; kontrollera storleken på dess ruta, som måste anges i millimeter.</translation>
        </message>
        <message>
            <source>The boards are tilted too little to tell where the depth camera stands; tilt the board by 20 to 40 degrees about both of its sides and take more.</source>
            <translation>Brädena är för lite lutade för att visa var djupkameran sitter; luta brädet 20 till 40 grader kring båda sidorna och ta fler.</translation>
        </message>
        <message>
            <source>The body weights of {name} must go from light to heavy; change them.</source>
            <translation>Kroppsvikterna för {name} måste gå från lätt till tung; ändra dem.</translation>
        </message>
        <message>
            <source>The border that the station is on</source>
            <translation>Kanten som punkten ligger på</translation>
        </message>
        <message>
            <source>The box around the imprint was left out: {percent:.0f} % of what was scanned.</source>
            <translation>Lådan runt avtrycket har utelämnats: {percent:.0f} % av det som skannades.</translation>
        </message>
        <message>
            <source>The calibration of sensor {serial} cannot be read; undo its last step under Calibrate sensors, or by insole-studio calibrate undo --serial {serial}: {reason}</source>
            <translation>Kalibreringen av sensor {serial} kan inte läsas; ångra dess senaste steg under Kalibrera sensorer, eller med insole-studio calibrate undo --serial {serial}: {reason}</translation>
        </message>
        <message>
            <source>The cameras are {baseline_mm:.1f} mm apart ({x:.1f}, {y:.1f}, {z:.1f}) and turned by {turn_deg:.2f}°, from {count} {source}.</source>
            <translation>Kamerorna är {baseline_mm:.1f} mm från varandra ({x:.1f}, {y:.1f}, {z:.1f}) och vridna {turn_deg:.2f}°, enligt {count} {source}.</translation>
        </message>
        <message>
            <source>The capture was stopped.</source>
            <translation>Avbildningen avbröts.</translation>
        </message>
        <message>
            <source>The captures come from different sensors: {sensors}; calibrate one sensor at a time.</source>
            <translation>Tagningarna kommer från olika sensorer: {sensors}; kalibrera en sensor i taget.</translation>
        </message>
        <message>
            <source>The case has no such foot; open or capture one first.</source>
            <translation>Fallet har ingen sådan fot; öppna eller avbilda en först.</translation>
        </message>
        <message>
            <source>The case has no {side} foot, so the map has none to lie under; open its scan first.</source>
            <translation>Den fot som bilden visar ({side}) finns inte i fallet, så bilden har ingen fot att ligga under; öppna först dess skanning.</translation>
        </message>
        <message>
            <source>The clinic's device "{name}" is gone, so new designs start with "{usual}"; choose another one as the clinic's.</source>
            <translation>Klinikens inlägg "{name}" finns inte längre, så nya ordinationer börjar med "{usual}"; välj ett annat som klinikens.</translation>
        </message>
        <message>
            <source>The clinic's record is not open.</source>
            <translation>Klinikens journal är inte öppen.</translation>
        </message>
        <message>
            <source>The clinic's record is not open; look at the start page to see why.</source>
            <translation>Klinikens journal är inte öppen; startsidan säger varför.</translation>
        </message>
        <message>
            <source>The colour camera of this sensor was not calibrated yet, so the board on the walls cannot tell where they are; calibrate it, and depth to colour, first.</source>
            <translation>Sensorns färgkamera är inte kalibrerad ännu, så brädet på väggarna kan inte visa var de är; kalibrera den, och djup mot färg, först.</translation>
        </message>
        <message>
            <source>The colour camera of this sensor was not calibrated yet; calibrate it first, the same pictures will do.</source>
            <translation>Sensorns färgkamera är inte kalibrerad ännu; kalibrera den först, samma bilder duger.</translation>
        </message>
        <message>
            <source>The colour picture of view {view} is too bright; turn strong lights away and capture this view again.</source>
            <translation>Färgbilden av vyn {view} är för ljus; vänd bort starka lampor och ta vyn igen.</translation>
        </message>
        <message>
            <source>The colour picture of view {view} is too dark; add light and capture this view again.</source>
            <translation>Färgbilden av vyn {view} är för mörk; tänd mer ljus och ta vyn igen.</translation>
        </message>
        <message>
            <source>The colour picture of view {view} was taken {apart_ms:.0f} ms apart from its depth; hold the foot still and capture this view again.</source>
            <translation>Färgbilden i vyn {view} togs {apart_ms:.0f} ms från dess djup; håll foten stilla och avbilda vyn igen.</translation>
        </message>
        <message>
            <source>The contact does not look like the sole of this foot; check the patient and the distance of the sensors, or lay it by hand.</source>
            <translation>Kontakten ser inte ut som sulan på den här foten; kontrollera patienten och sensorernas avstånd, eller lägg den för hand.</translation>
        </message>
        <message>
            <source>The contact is {length:.0f} mm long on a foot of {foot:.0f} mm, too little to find its place; lay it by hand.</source>
            <translation>Kontakten är {length:.0f} mm lång på en fot på {foot:.0f} mm, för lite för att hitta dess plats; lägg den för hand.</translation>
        </message>
        <message>
            <source>The copy {copy} could not be put back ({reason}), so the record stays as it was; free some space, or choose another copy.</source>
            <translation>Kopian {copy} kunde inte återställas ({reason}), så journalen är kvar som den var; frigör utrymme eller välj en annan kopia.</translation>
        </message>
        <message>
            <source>The copy {path} of unsaved work is damaged; it is kept as {kept} for {days} days.</source>
            <translation>Kopian {path} av osparat arbete är skadad; den sparas som {kept} i {days} dagar.</translation>
        </message>
        <message>
            <source>The correction is not for the depth of sensor {serial}, a {model}; use one that was measured on this kind of sensor.</source>
            <translation>Korrektionen gäller inte djupet från sensor {serial}, en {model}; använd en som mättes på detta slags sensor.</translation>
        </message>
        <message>
            <source>The correction is {age}; calibrate the sensor again soon.</source>
            <translation>Korrektionen är {age}; kalibrera om sensorn snart.</translation>
        </message>
        <message>
            <source>The correction needs captures of the wall at {least} distances or more, but only {count} can be used; capture more.</source>
            <translation>Korrektionen behöver tagningar av väggen på {least} avstånd eller fler, men bara {count} kan användas; ta fler.</translation>
        </message>
        <message>
            <source>The correction was measured on sensor {owner}, not on {serial}</source>
            <translation>Korrektionen mättes på sensor {owner}, inte på {serial}</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" goes {free:g} mm deep into a hole, and the holes for the dowels are {depth:g} mm deep; take a longer cutter for the contour.</source>
            <translation>Fräsen ”{cutter}” går {free:g} mm djupt i ett hål, och hålen för styrpinnarna är {depth:g} mm djupa; ta en längre fräs för konturen.</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" is too thick for a hollow of the {side} at x = {x:.0f} mm, y = {y:.0f} mm of the block: {left:.1f} mm stay there; take a thinner one.</source>
            <translation>Fräsen ”{cutter}” är för tjock för en fördjupning på {side} vid x = {x:.0f} mm, y = {y:.0f} mm i blocket: {left:.1f} mm blir kvar där; ta en tunnare.</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" is too thick for a hollow of the {side}, {heel:.0f} mm from the heel in the middle: {left:.1f} mm stay there; take a thinner one.</source>
            <translation>Fräsen ”{cutter}” är för tjock för en fördjupning på {side}, {heel:.0f} mm från hälen i mitten: {left:.1f} mm blir kvar där; ta en tunnare.</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" is too thick for a hollow of the {side}, {heel:.0f} mm from the heel on the lateral side: {left:.1f} mm stay there; take a thinner one.</source>
            <translation>Fräsen ”{cutter}” är för tjock för en fördjupning på {side}, {heel:.0f} mm från hälen på utsidan: {left:.1f} mm blir kvar där; ta en tunnare.</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" is too thick for a hollow of the {side}, {heel:.0f} mm from the heel on the medial side: {left:.1f} mm stay there; take a thinner one.</source>
            <translation>Fräsen ”{cutter}” är för tjock för en fördjupning på {side}, {heel:.0f} mm från hälen på insidan: {left:.1f} mm blir kvar där; ta en tunnare.</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" of the contour needs {need:g} mm between two pieces, and some lie nearer to each other; lay them farther apart, or take a thinner cutter.</source>
            <translation>Konturens fräs ”{cutter}” behöver {need:g} mm mellan två stycken, och några ligger närmare varandra; lägg dem längre isär eller ta en tunnare fräs.</translation>
        </message>
        <message>
            <source>The cutter "{cutter}" reaches {reach:g} mm, and must go {depth:.1f} mm deep; take a lower block or a longer cutter.</source>
            <translation>Fräsen ”{cutter}” når {reach:g} mm och måste gå {depth:.1f} mm djupt; ta ett lägre block eller en längre fräs.</translation>
        </message>
        <message>
            <source>The cutter parks. Put in cutter {cutter}, set its height again, and go on.</source>
            <translation>Fräsen parkerar. Sätt i fräs {cutter}, ställ dess höjd på nytt och fortsätt.</translation>
        </message>
        <message>
            <source>The cutter parks. {step}</source>
            <translation>Fräsen parkerar. {step}</translation>
        </message>
        <message>
            <source>The data of this person were erased; nothing can be added to them.</source>
            <translation>Den här personens uppgifter har raderats; inget kan läggas till.</translation>
        </message>
        <message>
            <source>The data of this person were erased; the merge cannot be undone.</source>
            <translation>Den här personens uppgifter har raderats; sammanslagningen kan inte ångras.</translation>
        </message>
        <message>
            <source>The database is damaged ({reason}); restore it from a backup.</source>
            <translation>Databasen är skadad ({reason}); återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>The database is damaged: restore the newest backup.</source>
            <translation>Databasen är skadad: återställ den nyaste säkerhetskopian.</translation>
        </message>
        <message>
            <source>The database {file} is missing, but the files of the record beside it are there; restore the record from a backup, or bring the database back to its place.</source>
            <translation>Databasen {file} saknas, men journalens filer bredvid den finns kvar; återställ journalen från en säkerhetskopia eller lägg tillbaka databasen.</translation>
        </message>
        <message>
            <source>The delivery date {day} is more than two years ahead; check the year.</source>
            <translation>Leveransdagen {day} ligger mer än två år fram; kontrollera året.</translation>
        </message>
        <message>
            <source>The delivery date {day} is past; choose a day from {today} on.</source>
            <translation>Leveransdagen {day} har passerat; välj en dag från och med {today}.</translation>
        </message>
        <message>
            <source>The depth image has no readings; capture it again.</source>
            <translation>Djupbilden har inga mätvärden; ta om den.</translation>
        </message>
        <message>
            <source>The depth of view {view} was still changing when it was captured; hold the foot still and capture this view again.</source>
            <translation>Djupet i vyn {view} ändrades ännu när den togs; håll foten stilla och ta vyn igen.</translation>
        </message>
        <message>
            <source>The diameter of the {kind} is {size}, but must lie between {low:g} and {high:g} mm; give it in millimetres.</source>
            <translation>Diametern för föremålet ({kind}) är {size} men måste ligga mellan {low:g} och {high:g} mm; ange den i millimeter.</translation>
        </message>
        <message>
            <source>The distance is known within {error_mm:.1f} mm.</source>
            <translation>Avståndet är känt inom {error_mm:.1f} mm.</translation>
        </message>
        <message>
            <source>The distances differ by {share:+.0%} from what a usual Kinect v1 measures; make sure that they reach from the front of the sensor to the wall.</source>
            <translation>Avstånden avviker {share:+.0%} från vad en vanlig Kinect v1 mäter; se till att de räcker från sensorns framsida till väggen.</translation>
        </message>
        <message>
            <source>The distances reach from {nearest_mm:g} to {farthest_mm:g} mm; give them in millimetres, between {low_mm:g} and {high_mm:g}.</source>
            <translation>Avstånden går från {nearest_mm:g} till {farthest_mm:g} mm; ange dem i millimeter, mellan {low_mm:g} och {high_mm:g}.</translation>
        </message>
        <message>
            <source>The distortion leaves {residual_px:.3f} px of the walls' shifts (rms).</source>
            <translation>Förvrängningen lämnar {residual_px:.3f} px av väggarnas förskjutningar (rms).</translation>
        </message>
        <message>
            <source>The distortion of the depth was not corrected yet, which turns the cameras by a degree or two; calibrate the distortion first.</source>
            <translation>Djupets förvrängning är inte korrigerad ännu, vilket vrider kamerorna en grad eller två; kalibrera förvrängningen först.</translation>
        </message>
        <message>
            <source>The dowel at x = {x:.0f} mm, y = {y:.0f} mm of the block has no room beside the piece; take a longer block, or set it nearer to the end.</source>
            <translation>Styrpinnen vid x = {x:.0f} mm, y = {y:.0f} mm i blocket får inte plats bredvid stycket; ta ett längre block eller sätt den närmare änden.</translation>
        </message>
        <message>
            <source>The drawn outline of the insole crosses itself; move its points apart.</source>
            <translation>Inläggets ritade kontur korsar sig själv; flytta isär punkterna.</translation>
        </message>
        <message>
            <source>The edge is rounded by {least_mm:.1f} mm instead of {radius_mm:g} mm where the insole is too thin or its rim too steep for more, most at x = {x_mm:.0f} mm, y = {y_mm:.0f} mm, and less than asked for over {share:.0%} of its length.</source>
            <translation>Kanten är rundad med {least_mm:.1f} mm i stället för {radius_mm:g} mm där inlägget är för tunt eller dess rand för brant för mer, mest vid x = {x_mm:.0f} mm, y = {y_mm:.0f} mm, och mindre än begärt längs {share:.0%} av sin längd.</translation>
        </message>
        <message>
            <source>The environment variable {variable} sends connections to another server than the address of the database names; remove it, and name the server in the address.</source>
            <translation>Miljövariabeln {variable} skickar anslutningar till en annan server än den som databasens adress nämner; ta bort den och ange servern i adressen.</translation>
        </message>
        <message>
            <source>The face {face} was not measured and stays as planned: {reason}</source>
            <translation>Sidan {face} mättes inte och förblir som planerad: {reason}</translation>
        </message>
        <message>
            <source>The faces {faces} were measured together.</source>
            <translation>Sidorna {faces} mättes tillsammans.</translation>
        </message>
        <message>
            <source>The feet are ready</source>
            <translation>Fötterna är klara</translation>
        </message>
        <message>
            <source>The feet look exchanged: a right one is in the place of the left, and a left one in the place of the right; see that they are not crossed, and that the pictures are not flipped.</source>
            <translation>Fötterna verkar förväxlade: en högerfot är på vänsterfotens plats och en vänsterfot på högerfotens; se till att de inte är korsade och att bilderna inte är spegelvända.</translation>
        </message>
        <message>
            <source>The file does not say how the foot lies: of all ways it could stand, the one that looks most like a foot was taken.</source>
            <translation>Filen säger inte hur foten ligger: av alla sätt den kan stå på togs det som mest liknar en fot.</translation>
        </message>
        <message>
            <source>The file does not say in which unit it is: {choices}. Say which it is.</source>
            <translation>Filen anger inte sin enhet: {choices}. Ange vilken det är.</translation>
        </message>
        <message>
            <source>The file does not say the {what} of its numbers; state it.</source>
            <translation>Filen anger inte sina tals {what}; ange det.</translation>
        </message>
        <message>
            <source>The file is in {stated} by what it says, in which it is no foot: {choices}. Say which it is.</source>
            <translation>Filen är enligt sig själv i {stated}, men då är det ingen fot: {choices}. Ange vilken enheten är.</translation>
        </message>
        <message>
            <source>The file named above, with this SHA-256, belongs to this sheet. All lengths are in millimetres.</source>
            <translation>Filen som nämns ovan, med denna SHA-256, hör till detta blad. Alla längder är i millimeter.</translation>
        </message>
        <message>
            <source>The file of colours {library} is not beside the scan or cannot be read; the scan has no colours.</source>
            <translation>Färgfilen {library} ligger inte bredvid skanningen eller kan inte läsas; skanningen har inga färger.</translation>
        </message>
        <message>
            <source>The file {name} of the record is missing in {folder}; restore it from a backup.</source>
            <translation>Journalens fil {name} saknas i {folder}; återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>The finding "{finding}" proposes the pad {kind} {size}, and the pad library has none; choose another one in the clinic's findings.</source>
            <translation>Fyndet "{finding}" föreslår pelotten {kind} {size}, som inte finns i pelottbiblioteket; välj en annan i klinikens fynd.</translation>
        </message>
        <message>
            <source>The focal length is {fx:.1f} / {fy:.1f} px, known within {error_px:.1f} px.</source>
            <translation>Brännvidden är {fx:.1f} / {fy:.1f} px, känd inom {error_px:.1f} px.</translation>
        </message>
        <message>
            <source>The folder of the backups, {folder}, is not there; connect its disk, or choose another folder.</source>
            <translation>Mappen för säkerhetskopiorna, {folder}, finns inte; anslut dess disk eller välj en annan mapp.</translation>
        </message>
        <message>
            <source>The folder of the large files, {folder}, is not there or may not be written by you; connect the share, or choose another folder.</source>
            <translation>Mappen för de stora filerna, {folder}, finns inte eller får inte skrivas av dig; anslut den delade platsen eller välj en annan mapp.</translation>
        </message>
        <message>
            <source>The font has no letters {missing}; the identification shows a likeness or “?” instead.</source>
            <translation>Typsnittet saknar tecknen {missing}; märkningen visar något liknande eller ”?” i stället.</translation>
        </message>
        <message>
            <source>The font has none of the letters of “{text}”; write the identification in other letters, such as a number.</source>
            <translation>Typsnittet har inga av bokstäverna i ”{text}”; skriv märkningen med andra tecken, till exempel ett nummer.</translation>
        </message>
        <message>
            <source>The font of the papers has no letters {missing}, and “?” is printed for them; write the name or the text in Latin letters too.</source>
            <translation>Papperens typsnitt saknar bokstäverna {missing}, och ”?” skrivs i deras ställe; skriv namnet eller texten även med latinska bokstäver.</translation>
        </message>
        <message>
            <source>The foot is not level: the ball lies {higher_mm:.0f} mm higher than the heel ({angle:g}°), and the insole is as much thicker below it; turn the foot toes down by {angle:g}°, or scan it again with heel and ball on one level.</source>
            <translation>Foten ligger inte plant: trampdynan ligger {higher_mm:.0f} mm högre än hälen ({angle:g}°), och inlägget är lika mycket tjockare under den; vrid foten {angle:g}° med tårna nedåt, eller skanna den igen med häl och trampdyna i samma nivå.</translation>
        </message>
        <message>
            <source>The foot is not level: the heel lies {higher_mm:.0f} mm higher than the ball ({angle:g}°), and the insole is as much thicker below it; turn the foot toes up by {angle:g}°, or scan it again with heel and ball on one level.</source>
            <translation>Foten ligger inte plant: hälen ligger {higher_mm:.0f} mm högre än trampdynan ({angle:g}°), och inlägget är lika mycket tjockare under den; vrid foten {angle:g}° med tårna uppåt, eller skanna den igen med häl och trampdyna i samma nivå.</translation>
        </message>
        <message>
            <source>The foot is ready</source>
            <translation>Foten är klar</translation>
        </message>
        <message>
            <source>The foot is {length_mm:.0f} mm long.</source>
            <translation>Foten är {length_mm:.0f} mm lång.</translation>
        </message>
        <message>
            <source>The foot is {longer:.0f} mm longer than the shoe {shoe} is inside; check the size.</source>
            <translation>Foten är {longer:.0f} mm längre än skon {shoe} är invändigt; kontrollera storleken.</translation>
        </message>
        <message>
            <source>The foot lies as heel, toe and sole were clicked.</source>
            <translation>Foten ligger så som häl, tå och sula klickades.</translation>
        </message>
        <message>
            <source>The foot may lie in another way as well: taken is a {side} foot, {length}, turned otherwise it is {others}; see that heel, toes and sole are right.</source>
            <translation>Foten kan också ligga på ett annat sätt: den tas som {side} fot, {length}, vänd på annat sätt är den {others}; se efter att häl, tår och sula stämmer.</translation>
        </message>
        <message>
            <source>The foot was pressed into foam, so its tissue is spread by weight already: no expansion is proposed.</source>
            <translation>Foten har tryckts ner i skum, så dess vävnad är redan utbredd av belastningen: inget mjukdelstillägg föreslås.</translation>
        </message>
        <message>
            <source>The foot was recorded with a part of the weight on it: the sole is flatter than without it, and reliefs are understated.</source>
            <translation>Foten spelades in med en del av vikten på: sulan är plattare än utan den, och avlastningar underskattas.</translation>
        </message>
        <message>
            <source>The foot was recorded with the weight on it, and its sole is flat then; how load moves can only be told from a foot without weight on it.</source>
            <translation>Foten spelades in med vikten på, och då är dess sula platt; hur lasten flyttas kan bara sägas av en fot utan vikt på.</translation>
        </message>
        <message>
            <source>The foot would be {length_mm:.0f} mm long, which few feet are; check the unit.</source>
            <translation>Foten skulle vara {length_mm:.0f} mm lång, vilket få fötter är; kontrollera enheten.</translation>
        </message>
        <message>
            <source>The foot's shape is a {shape_side} one, but a {side} foot is to be simulated; give both the same side.</source>
            <translation>Fotens form är en {shape_side} fots, men en {side} fot ska simuleras; ge båda samma sida.</translation>
        </message>
        <message>
            <source>The forefoot is posted by {angle:g}° {edge}; more than {usual:g}° is unusual.</source>
            <translation>Framfoten är kilad {angle:g}° {edge}; mer än {usual:g}° är ovanligt.</translation>
        </message>
        <message>
            <source>The forefoot is {missing_mm:g} mm too thin for the rocker, which leaves {least_mm:g} mm of material; raise the thickness or lower the slope.</source>
            <translation>Framfoten är {missing_mm:g} mm för tunn för rullsulan, som lämnar {least_mm:g} mm material; höj tjockleken eller minska lutningen.</translation>
        </message>
        <message>
            <source>The form "{form}" is that of a foot of {form_mm:.0f} mm, and this one is {foot_mm:.0f} mm long; choose a form of about its length.</source>
            <translation>Formen "{form}" är gjord för en fot på {form_mm:.0f} mm, och den här är {foot_mm:.0f} mm lång; välj en form av ungefär dess längd.</translation>
        </message>
        <message>
            <source>The frames show nothing at a distance that the sensor measures; record a wall 500 to 3000 mm away.</source>
            <translation>Bilderna visar inget på ett avstånd som sensorn mäter; spela in en vägg 500 till 3000 mm bort.</translation>
        </message>
        <message>
            <source>The front edge is to taper to {taper_mm:g} mm, and {material} needs {least_mm:g} mm there; it is made {least_mm:g} mm thick.</source>
            <translation>Framkanten ska smalna av till {taper_mm:g} mm, och {material} behöver {least_mm:g} mm där; den görs {least_mm:g} mm tjock.</translation>
        </message>
        <message>
            <source>The front edge of the {pad} lies {distance_mm:.1f} mm ahead of the line of the heads 2 to 4; the clinic's rule is {least_mm:g} to {most_mm:g} mm behind it.</source>
            <translation>Framkanten ({pad}) ligger {distance_mm:.1f} mm framför linjen genom metatarsalhuvud 2 till 4; klinikens regel är {least_mm:g} till {most_mm:g} mm bakom den.</translation>
        </message>
        <message>
            <source>The front edge of the {pad} lies {distance_mm:.1f} mm behind the line of the heads 2 to 4; the clinic's rule is {least_mm:g} to {most_mm:g} mm behind it.</source>
            <translation>Framkanten ({pad}) ligger {distance_mm:.1f} mm bakom linjen genom metatarsalhuvud 2 till 4; klinikens regel är {least_mm:g} till {most_mm:g} mm bakom den.</translation>
        </message>
        <message>
            <source>The greatest pressure is {greatest:.0f} kPa, and a foot presses with more than 0 and at most {most:.0f} kPa; check the unit and the frame.</source>
            <translation>Det största trycket är {greatest:.0f} kPa, och en fot trycker med mer än 0 och högst {most:.0f} kPa; kontrollera enheten och bilden i serien.</translation>
        </message>
        <message>
            <source>The greatest pressure is {kpa:.0f} kPa, little for a foot that stands; check the unit.</source>
            <translation>Det största trycket är {kpa:.0f} kPa, lite för en fot som står; kontrollera enheten.</translation>
        </message>
        <message>
            <source>The grid of {grid_mm:g} mm is too coarse for a smooth insole; up to {usual_mm:g} mm are usual.</source>
            <translation>Rutnätet av {grid_mm:g} mm är för grovt för ett jämnt inlägg; upp till {usual_mm:g} mm är vanligt.</translation>
        </message>
        <message>
            <source>The heel is lifted by {height_mm:g} mm; on the device up to {usual_mm:g} mm are usual.</source>
            <translation>Hälen är höjd {height_mm:g} mm; på inlägget är upp till {usual_mm:g} mm vanligt.</translation>
        </message>
        <message>
            <source>The heel is missing, or cut off behind; lengths and everything placed from the heel are guesses. Scan the foot again with its heel.</source>
            <translation>Hälen saknas, eller är avskuren baktill; längder och allt som placeras från hälen är gissningar. Skanna foten igen med hälen.</translation>
        </message>
        <message>
            <source>The heel is widened by {expansion_mm:.1f} mm, and the outline lies only {beside_mm:.1f} mm behind the foot; widen the outline at the heel by as much.</source>
            <translation>Hälen breddas med {expansion_mm:.1f} mm, och konturen ligger bara {beside_mm:.1f} mm bakom foten; bredda konturen vid hälen lika mycket.</translation>
        </message>
        <message>
            <source>The heel is widened by {expansion_mm:.1f} mm, but in an imprint or a cast taken under weight the tissue is spread already; set the expansion to 0.</source>
            <translation>Hälen breddas med {expansion_mm:.1f} mm, men i ett avtryck eller en avgjutning som tagits under belastning är vävnaden redan utbredd; sätt mjukdelstillägget till 0.</translation>
        </message>
        <message>
            <source>The heel lifts add up to {lift_mm:g} mm, and must be {range}; lower some of them.</source>
            <translation>Hälhöjningarna blir tillsammans {lift_mm:g} mm, och måste vara {range}; sänk några av dem.</translation>
        </message>
        <message>
            <source>The identification does not lie wholly on a flat bottom; write it elsewhere, smaller, or make the bottom flat.</source>
            <translation>Märkningen ligger inte helt på en plan undersida; skriv den på annan plats, mindre, eller gör undersidan plan.</translation>
        </message>
        <message>
            <source>The identification is empty; write a pseudonym, side or date.</source>
            <translation>Märkningen är tom; skriv en pseudonym, sida eller ett datum.</translation>
        </message>
        <message>
            <source>The identification is too long for its place; shorten it, so that its letters can be at least {least_mm:g} mm high.</source>
            <translation>Märkningen är för lång för sin plats; korta den, så att bokstäverna kan vara minst {least_mm:g} mm höga.</translation>
        </message>
        <message>
            <source>The imprint in the foam, {depth_mm:.0f} mm deep, does not look like a foot; see that heel, ball and toes are pressed in, and take it again.</source>
            <translation>Avtrycket i skummet, {depth_mm:.0f} mm djupt, liknar ingen fot; se till att häl, framfot och tår trycks ner, och ta det på nytt.</translation>
        </message>
        <message>
            <source>The imprint or cast was taken under a part of the weight: the sole is flatter than without it, and reliefs are understated.</source>
            <translation>Avtrycket eller avgjutningen togs under en del av tyngden: sulan är plattare än utan den, och avlastningar underskattas.</translation>
        </message>
        <message>
            <source>The inside of the shoe crosses itself; choose the shoe again.</source>
            <translation>Skons insida korsar sig själv; välj skon igen.</translation>
        </message>
        <message>
            <source>The insole does not reach the zone {zone}.</source>
            <translation>Inlägget når inte till zonen {zone}.</translation>
        </message>
        <message>
            <source>The insole is too thin there: it is compressed by more than half.</source>
            <translation>Inlägget är för tunt där: det trycks ihop till mer än hälften.</translation>
        </message>
        <message>
            <source>The insole is up to {over:.1f} mm wider than the shoe {shoe}, {place}; trim it to the shoe, or take another size.</source>
            <translation>Inlägget är upp till {over:.1f} mm bredare än skon {shoe}, {place}; skär det efter skon eller ta en annan storlek.</translation>
        </message>
        <message>
            <source>The insole is {height_mm:.0f} mm high and may not fit a shoe; up to {usual_mm:g} mm are usual.</source>
            <translation>Inlägget är {height_mm:.0f} mm högt och får kanske inte plats i en sko; upp till {usual_mm:g} mm är vanligt.</translation>
        </message>
        <message>
            <source>The insole would be only {thickness_mm:.1f} mm thick at x = {x_mm:.0f} mm, y = {y_mm:.0f} mm; raise the thickness or make the recess shallower.</source>
            <translation>Inlägget skulle bara bli {thickness_mm:.1f} mm tjockt vid x = {x_mm:.0f} mm, y = {y_mm:.0f} mm; öka tjockleken eller gör fördjupningen grundare.</translation>
        </message>
        <message>
            <source>The insole would be {height_mm:.0f} mm high, and {most_mm:g} mm can be made; lower the corrections that lie on each other.</source>
            <translation>Inlägget skulle bli {height_mm:.0f} mm högt, och {most_mm:g} mm kan tillverkas; sänk de korrigeringar som ligger på varandra.</translation>
        </message>
        <message>
            <source>The known length ends at {markers}, which the pictures do not show twice; take more pictures or measure between other markers.</source>
            <translation>Den kända längden slutar vid {markers}, som bilderna inte visar två gånger; ta fler bilder eller mät mellan andra markörer.</translation>
        </message>
        <message>
            <source>The known length goes from {first} on face {first_face} to {second} on face {second_face}, but nothing links these faces; measure between two markers of one face, or take pictures that show four markers of both.</source>
            <translation>Den kända längden går från {first} på sidan {first_face} till {second} på sidan {second_face}, men inget förbinder dessa sidor; mät mellan två markörer på en sida, eller ta bilder som visar fyra markörer på båda.</translation>
        </message>
        <message>
            <source>The landmarks stand in an order that no foot has: heel centre, 1st and 5th head and the tip of the 2nd toe must lie around the sole; drag them to their places, or find the landmarks anew.</source>
            <translation>Landmärkena står i en ordning som ingen fot har: hälens mitt, 1:a och 5:e huvudet och spetsen av 2:a tån måste ligga runt fotsulan; dra dem till sina platser, eller sök landmärkena på nytt.</translation>
        </message>
        <message>
            <source>The landmarks {landmark} and {other_landmark} stand in an order that no foot has; drag them to where they belong.</source>
            <translation>Landmärkena {landmark} och {other_landmark} står i en ordning som ingen fot har; dra dem dit de hör.</translation>
        </message>
        <message>
            <source>The last digit of {text} does not fit the others; compare it with the patient's card.</source>
            <translation>Den sista siffran i {text} stämmer inte med de andra; jämför med patientens legitimation.</translation>
        </message>
        <message>
            <source>The learnt correction is off for the sensors {serials}, because a proof on {date} found it to do harm.</source>
            <translation>Den inlärda korrektionen är avstängd för sensorerna {serials}, eftersom ett prov {date} visade att den skadar.</translation>
        </message>
        <message>
            <source>The left foot is {left_mm:.0f} mm long and the right one {right_mm:.0f} mm; check that both scans are of this patient, and in the same unit.</source>
            <translation>Vänster fot är {left_mm:.0f} mm lång och höger {right_mm:.0f} mm; kontrollera att båda skanningarna är av denna patient, och i samma enhet.</translation>
        </message>
        <message>
            <source>The leg was cut off {height_mm:.0f} mm over the sole.</source>
            <translation>Benet skars av {height_mm:.0f} mm över sulan.</translation>
        </message>
        <message>
            <source>The level from which the height is counted</source>
            <translation>Nivån som höjden räknas från</translation>
        </message>
        <message>
            <source>The limit "{key}" has no number to judge in this evaluation; take it out, or use one of {known}.</source>
            <translation>Gränsen ”{key}” har inget tal att bedöma i denna utvärdering; ta bort den, eller använd en av {known}.</translation>
        </message>
        <message>
            <source>The load that a heel lift moves forwards is not shown: its centre stays where it usually is.</source>
            <translation>Den belastning som en hälhöjning flyttar framåt visas inte: dess mitt stannar där den brukar vara.</translation>
        </message>
        <message>
            <source>The manual is missing from this installation; install Insole Studio again, or in its source, run make manual.</source>
            <translation>Handboken saknas i den här installationen; installera Insole Studio igen, eller kör make manual i källkoden.</translation>
        </message>
        <message>
            <source>The map carries {measured:.0f} N, and in this posture the foot carries {load:.0f} N; it is of walking, of another posture or of another person, so choose one that fits.</source>
            <translation>Tryckbilden bär {measured:.0f} N, och i den här ställningen bär foten {load:.0f} N; den är av gång, av en annan ställning eller av en annan person, så välj en som passar.</translation>
        </message>
        <message>
            <source>The map does not press under heel and ball of this foot; see that it lies there.</source>
            <translation>Tryckbilden trycker inte under den här fotens häl och trampdyna; se till att den ligger där.</translation>
        </message>
        <message>
            <source>The map does not show whether it is that of a left or a right foot; check that it is that of the {side} one.</source>
            <translation>Tryckbilden visar inte om den är av en vänster eller höger fot; kontrollera att den är av den som är {side}.</translation>
        </message>
        <message>
            <source>The map looks like one of the other foot; lay the map of the {side} foot.</source>
            <translation>Tryckbilden ser ut som en av den andra foten; lägg en av {side} fot.</translation>
        </message>
        <message>
            <source>The marker {marker} is seen {distances} from its place by {views} and does not count; see whether it was moved.</source>
            <translation>Markören {marker} ses {distances} från sin plats av {views} och räknas inte; se om den flyttats.</translation>
        </message>
        <message>
            <source>The markers of the view {view} leave its place uncertain by {uncertainty_mm:.1f} mm at the foot; see that more of them are in view.</source>
            <translation>Markörerna i vyn {view} lämnar dess plats osäker med {uncertainty_mm:.1f} mm vid foten; se till att fler av dem syns.</translation>
        </message>
        <message>
            <source>The markers of the view {view} were corrected by hand: {corrections}.</source>
            <translation>Markörerna i vyn {view} korrigerades för hand: {corrections}.</translation>
        </message>
        <message>
            <source>The mesh is open or crosses itself; only a closed solid can be worked.</source>
            <translation>Ytmodellen är öppen eller korsar sig själv; bara en sluten kropp kan bearbetas.</translation>
        </message>
        <message>
            <source>The model does not always meet published series here, measured in walking; of some pads and bars not even the direction is right.</source>
            <translation>Modellen återger här inte alltid publicerade serier, mätta vid gång; för vissa pelotter och barer stämmer inte ens riktningen.</translation>
        </message>
        <message>
            <source>The model needs walls at {count} clearly different distances; capture more, for example at 600, 800 and 1000 mm.</source>
            <translation>Modellen behöver väggar på {count} tydligt olika avstånd; ta fler, till exempel på 600, 800 och 1000 mm.</translation>
        </message>
        <message>
            <source>The most pressed place is now one where nothing pressed before.</source>
            <translation>Den mest tryckta platsen är nu en där inget tryckte förut.</translation>
        </message>
        <message>
            <source>The most pressed place is relieved, but the region carries more in all.</source>
            <translation>Det mest tryckta stället avlastas, men området bär mer totalt.</translation>
        </message>
        <message>
            <source>The name or the password is wrong; try again, or ask the administrator for another password.</source>
            <translation>Namnet eller lösenordet är fel; försök igen, eller be administratören om ett nytt lösenord.</translation>
        </message>
        <message>
            <source>The noise needs at least two frames with readings; record more.</source>
            <translation>Bruset behöver minst två bilder med mätvärden; spela in fler.</translation>
        </message>
        <message>
            <source>The number of walls is {count}; give 1 to {most}.</source>
            <translation>Antalet väggar är {count}; ange 1 till {most}.</translation>
        </message>
        <message>
            <source>The one line is what was written, and none is missing.</source>
            <translation>Den enda raden är vad som skrevs, och ingen saknas.</translation>
        </message>
        <message>
            <source>The only variant of a foot cannot be deleted; empty it instead.</source>
            <translation>En fots enda variant kan inte tas bort; töm den i stället.</translation>
        </message>
        <message>
            <source>The order has no number; give it one.</source>
            <translation>Beställningen har inget nummer; ge den ett.</translation>
        </message>
        <message>
            <source>The order holds nothing; name at least one case.</source>
            <translation>Beställningen är tom; ange minst ett fall.</translation>
        </message>
        <message>
            <source>The order {number} has a revision {release} already, of somebody else; export once more, under the next number.</source>
            <translation>Beställningen {number} har redan en revision {release}, av någon annan; exportera en gång till, med nästa nummer.</translation>
        </message>
        <message>
            <source>The order {number} is {state} already; choose another state.</source>
            <translation>Beställningen {number} är redan {state}; välj ett annat läge.</translation>
        </message>
        <message>
            <source>The order {number} was {state} meanwhile; export once more, as a new order.</source>
            <translation>Beställningen {number} har under tiden fått läget {state}; exportera en gång till, som en ny beställning.</translation>
        </message>
        <message>
            <source>The orders ask for {materials}, and a block is of one material; nest them apart.</source>
            <translation>Beställningarna gäller {materials}, och ett block är av ett material; lägg ut dem var för sig.</translation>
        </message>
        <message>
            <source>The orders have {count} pieces, and a nest takes at most {most}; nest fewer orders.</source>
            <translation>Beställningarna har {count} stycken, och en samläggning tar högst {most}; lägg ut färre beställningar.</translation>
        </message>
        <message>
            <source>The origin of {machine} lies outside the block: {place:g} mm along {axis}, and the block has {size:g} mm; correct its offset in the machine file.</source>
            <translation>Nollpunkten för {machine} ligger utanför blocket: {place:g} mm längs {axis}, och blocket har {size:g} mm; rätta dess förskjutning i maskinfilen.</translation>
        </message>
        <message>
            <source>The outline encloses only {area_mm2:.0f} mm², which leaves no insole; draw it round the foot.</source>
            <translation>Konturen omsluter bara {area_mm2:.0f} mm², vilket inte ger något inlägg; rita den runt foten.</translation>
        </message>
        <message>
            <source>The outline lies beside the foot, which leaves no insole; draw it round the foot.</source>
            <translation>Konturen ligger bredvid foten, vilket inte ger något inlägg; rita den runt foten.</translation>
        </message>
        <message>
            <source>The pair needs a block of {need} mm, and this one has {there} mm; take a larger block, or one for each side.</source>
            <translation>Paret behöver ett block på {need} mm, och detta har {there} mm; ta ett större block, eller ett för varje sida.</translation>
        </message>
        <message>
            <source>The pair needs {need} mm, and the block has {there} mm.</source>
            <translation>Paret behöver {need} mm, och blocket har {there} mm.</translation>
        </message>
        <message>
            <source>The passphrase of a backup needs at least {least} characters; take four words or more, and keep it where the backup is not.</source>
            <translation>Lösenfrasen till en säkerhetskopia behöver minst {least} tecken; ta fyra ord eller fler, och förvara den på ett annat ställe än säkerhetskopian.</translation>
        </message>
        <message>
            <source>The passphrase or private key does not open this backup; check how it is written, and that it is that of this backup.</source>
            <translation>Lösenfrasen eller den privata nyckeln öppnar inte den här säkerhetskopian; kontrollera hur den skrivs, och att den hör till den här säkerhetskopian.</translation>
        </message>
        <message>
            <source>The password has {count} characters; take {least} to {most}, such as four words.</source>
            <translation>Lösenordet har {count} tecken; ta {least} till {most}, till exempel fyra ord.</translation>
        </message>
        <message>
            <source>The password is among the first that are tried: a name, or keys in a row; take four words, for example.</source>
            <translation>Lösenordet är bland de första som provas: ett namn, eller tangenter i rad; ta till exempel fyra ord.</translation>
        </message>
        <message>
            <source>The password of {account} was chosen by somebody else; choose your own.</source>
            <translation>Lösenordet för {account} har valts av någon annan; välj ditt eget.</translation>
        </message>
        <message>
            <source>The password repeats few characters; take four words, for example.</source>
            <translation>Lösenordet upprepar få tecken; ta till exempel fyra ord.</translation>
        </message>
        <message>
            <source>The pattern has drifted by {shift:.3f} px (at most {most} px); let the sensor warm up, and learn the reference again.</source>
            <translation>Mönstret har flyttat sig {shift:.3f} px (högst {most} px); låt sensorn bli varm, och lär in mönstret på nytt.</translation>
        </message>
        <message>
            <source>The person was merged with another one since then; undo that later merge first.</source>
            <translation>Personen har sedan dess slagits samman med en annan; ångra den senare sammanslagningen först.</translation>
        </message>
        <message>
            <source>The picked points cannot place one surface on the other: {reason}</source>
            <translation>De valda punkterna kan inte lägga den ena ytan på den andra: {reason}</translation>
        </message>
        <message>
            <source>The picture would be {longest:.0f} mm long, and a picture of a foot is {low:.0f} to {high:.0f} mm; check the dots per inch or the distance.</source>
            <translation>Bilden skulle bli {longest:.0f} mm lång, och en bild av en fot är {low:.0f} till {high:.0f} mm; kontrollera punkterna per tum eller avståndet.</translation>
        </message>
        <message>
            <source>The pictures are {width}×{height}, but the colour camera was calibrated at {known_width}×{known_height}; calibrate it with pictures of this size first.</source>
            <translation>Bilderna är {width}×{height}, men färgkameran kalibrerades vid {known_width}×{known_height}; kalibrera den först med bilder av denna storlek.</translation>
        </message>
        <message>
            <source>The pictures differ in size: {sizes}; use pictures of one camera in one mode.</source>
            <translation>Bilderna är olika stora: {sizes}; använd bilder från en kamera i ett läge.</translation>
        </message>
        <message>
            <source>The piece does not lie within the block; take a larger block.</source>
            <translation>Stycket ligger inte inom blocket; ta ett större block.</translation>
        </message>
        <message>
            <source>The piece finds no room on {block}; take a larger block.</source>
            <translation>Stycket får inte plats på {block}; ta ett större block.</translation>
        </message>
        <message>
            <source>The pieces are to lie {gap:g} mm apart and {margin:g} mm from the sides, and both must be 0 to {most:g} mm; correct them.</source>
            <translation>Styckena ska ligga {gap:g} mm från varandra och {margin:g} mm från sidorna, och båda måste vara 0 till {most:g} mm; rätta dem.</translation>
        </message>
        <message>
            <source>The pieces carry the serial number {made}, and it is {ordered} in the order; write it to another place, or without serial numbers on the pieces.</source>
            <translation>Styckena bär serienumret {made}, och i beställningen är det {ordered}; skriv den på en annan plats, eller utan serienummer på styckena.</translation>
        </message>
        <message>
            <source>The place lies beside the sole of the foot, or the sole is too steep or not measured there.</source>
            <translation>Stället ligger bredvid fotsulan, eller så är sulan för brant eller inte uppmätt där.</translation>
        </message>
        <message>
            <source>The place of the depth camera is known within {known_mm:.1f} mm only; for {good_mm} mm take more positions with the board turned by 40 to 55° ({sides}).</source>
            <translation>Djupkamerans plats är bara känd inom {known_mm:.1f} mm; för {good_mm} mm, ta fler lägen med brädet vridet 40 till 55° ({sides}).</translation>
        </message>
        <message>
            <source>The points of a sphere lie on no sphere; select the sphere alone.</source>
            <translation>Punkterna på en kula ligger inte på någon kula; välj bara kulan.</translation>
        </message>
        <message>
            <source>The points of {path} give no surface ({reason}); export it as a triangle mesh.</source>
            <translation>Punkterna i {path} ger ingen yta ({reason}); exportera den som ett triangelnät.</translation>
        </message>
        <message>
            <source>The points that should place one frame in another lie on one line; at least one beside it is needed.</source>
            <translation>Punkterna som ska lägga ett koordinatsystem i ett annat ligger på en linje; minst en bredvid den behövs.</translation>
        </message>
        <message>
            <source>The postings and twists turn the foot by {angle_deg:g}° together, and must be {range}; lower some of them.</source>
            <translation>Kilningar och vridningar vrider tillsammans foten {angle_deg:g}°, och måste vara {range}; sänk några av dem.</translation>
        </message>
        <message>
            <source>The prescription cannot be written without {missing}; put in what is missing.</source>
            <translation>Ordinationen kan inte skrivas utan {missing}; fyll i det som saknas.</translation>
        </message>
        <message>
            <source>The prescription cannot be written: {doubts} Correct it in the patient panel.</source>
            <translation>Ordinationen kan inte skrivas: {doubts} Rätta det i patientpanelen.</translation>
        </message>
        <message>
            <source>The prescription has {count} corrections, and {most} can be made into one insole; remove some.</source>
            <translation>Ordinationen har {count} korrigeringar, och {most} kan göras till ett inlägg; ta bort några.</translation>
        </message>
        <message>
            <source>The prescription of the {side} foot is not signed; sign it first.</source>
            <translation>Ordinationen för {side} fot är inte signerad; signera den först.</translation>
        </message>
        <message>
            <source>The prescription of the {side} foot is not what was signed; compare it with a backup.</source>
            <translation>Ordinationen för {side} fot är inte vad som signerades; jämför med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>The pressure under the {side} foot lies nowhere {zone}; change the limits or leave the zone out.</source>
            <translation>Trycket under foten ({side}) ligger ingenstans i zonen {zone}; ändra gränserna eller utelämna zonen.</translation>
        </message>
        <message>
            <source>The print is off by {off}; up to {most:g} % and {skew:g}° are corrected. Check the readings, in mm along x, y and z; if they are right, calibrate the printer and print the body again.</source>
            <translation>Utskriften avviker med {off}; upp till {most:g} % och {skew:g}° korrigeras. Kontrollera avläsningarna, i mm längs x, y och z; om de stämmer, kalibrera skrivaren och skriv ut kroppen igen.</translation>
        </message>
        <message>
            <source>The processor draws, which is slow: install the driver of the graphics card.</source>
            <translation>Processorn ritar, vilket går långsamt: installera grafikkortets drivrutin.</translation>
        </message>
        <message>
            <source>The program that reads the sensors has ended; look for sensors again.</source>
            <translation>Programmet som läser sensorerna har avslutats; sök efter sensorer igen.</translation>
        </message>
        <message>
            <source>The program that reads the sensors has not answered for {seconds:.0f} s and was stopped; complete views are kept. Look for sensors again.</source>
            <translation>Programmet som läser sensorerna har inte svarat på {seconds:.0f} s och avslutades; färdiga vyer är sparade. Sök efter sensorer igen.</translation>
        </message>
        <message>
            <source>The proportions are unusual for a foot: {scanned_mm:.0f} mm long, {ball_mm:.0f} mm wide at the ball, {midfoot_mm:.0f} mm in the middle, {heel_mm:.0f} mm at the heel; see that it is one whole foot.</source>
            <translation>Proportionerna är ovanliga för en fot: {scanned_mm:.0f} mm lång, {ball_mm:.0f} mm bred över trampdynan, {midfoot_mm:.0f} mm på mitten, {heel_mm:.0f} mm vid hälen; se efter att det är en hel fot.</translation>
        </message>
        <message>
            <source>The quantity is {quantity}, and must be 1 to {most}; correct it.</source>
            <translation>Antalet är {quantity} och måste vara 1 till {most}; rätta det.</translation>
        </message>
        <message>
            <source>The rearfoot is posted by {angle:g}° {edge}; more than {usual:g}° is unusual.</source>
            <translation>Bakfoten är kilad {angle:g}° {edge}; mer än {usual:g}° är ovanligt.</translation>
        </message>
        <message>
            <source>The record cannot be kept for {years} years: the law asks for at least {least} years, and {most} are the most; give a number between them.</source>
            <translation>Journalen kan inte sparas i {years} år: lagen kräver minst {least} år, och högst {most} går att ange; ange ett tal däremellan.</translation>
        </message>
        <message>
            <source>The record cannot use a database of the kind {kind}; give the address of a PostgreSQL server: postgresql+psycopg://user@server/database.</source>
            <translation>Journalen kan inte använda en databas av slaget {kind}; ange adressen till en PostgreSQL-server: postgresql+psycopg://user@server/database.</translation>
        </message>
        <message>
            <source>The record could not be copied to {copy} before it is brought up to date ({reason}), so it stays as it was; free some space, and try again.</source>
            <translation>Journalen kunde inte kopieras till {copy} innan den uppdateras ({reason}), så den är kvar som den var; frigör utrymme och försök igen.</translation>
        </message>
        <message>
            <source>The record is open for reading only, so nothing can be changed: {reason}</source>
            <translation>Journalen är bara öppen för läsning, så inget kan ändras: {reason}</translation>
        </message>
        <message>
            <source>The record refers to a file by "{name}", which is no SHA-256; restore the database from a backup.</source>
            <translation>Journalen hänvisar till en fil med ”{name}”, som inte är någon SHA-256; återställ databasen från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>The record was brought up to date; as it was before, it is kept as “{copy}”.</source>
            <translation>Journalen har uppdaterats; som den var före finns den kvar som ”{copy}”.</translation>
        </message>
        <message>
            <source>The reference pattern is of sensor {found}, but the calibration is of sensor {serial}; name the reference of that sensor.</source>
            <translation>Punktmönstret är av sensor {found}, men kalibreringen är av sensor {serial}; ange den sensorns mönster.</translation>
        </message>
        <message>
            <source>The reference system "{system}" has a place for one foot only; choose a foot, or set up the one for two feet, {pair}.</source>
            <translation>Referenssystemet ”{system}” har plats för en enda fot; välj en fot, eller ställ upp det för två fötter, {pair}.</translation>
        </message>
        <message>
            <source>The reference system "{system}" is for both feet; capture both, or set up the one for one foot, {single}.</source>
            <translation>Referenssystemet ”{system}” är för båda fötterna; avbilda båda, eller ställ upp det för en fot, {single}.</translation>
        </message>
        <message>
            <source>The result does not fit a Kinect v1: {findings}; {reason}.</source>
            <translation>Resultatet passar inte en Kinect v1: {findings}; {reason}.</translation>
        </message>
        <message>
            <source>The rim is {rim_mm:.0f} mm high {where}, and the scan of the foot reaches up to {flank_mm:.0f} mm beside it: above that the wall is designed, and no foot carries it; lower the rim, or scan more of the flank.</source>
            <translation>Randen är {rim_mm:.0f} mm hög {where}, och skanningen av foten når upp till {flank_mm:.0f} mm bredvid den: däröver är väggen konstruerad och bärs inte av foten; sänk randen eller skanna mer av fotens sida.</translation>
        </message>
        <message>
            <source>The rim is {rim_mm:.1f} mm high where a station {where} asks for {asked_mm:.1f} mm, or it would bend too sharply; move the neighbouring stations away or nearer to its height.</source>
            <translation>Randen är {rim_mm:.1f} mm hög där en station {where} anger {asked_mm:.1f} mm, annars skulle den böjas för skarpt; flytta grannstationerna bort eller närmare dess höjd.</translation>
        </message>
        <message>
            <source>The rim lies {below_mm:.1f} mm below the sole, so that the whole insole is {below_mm:.1f} mm thicker to keep its least thickness there; raise the rim or lower the posting.</source>
            <translation>Randen ligger {below_mm:.1f} mm under sulan, så att hela inlägget blir {below_mm:.1f} mm tjockare för att behålla minsta tjockleken där; höj randen eller minska kilningen.</translation>
        </message>
        <message>
            <source>The row has {count} cells under {headings} headings; check its quotation marks.</source>
            <translation>Raden har {count} celler under {headings} rubriker; kontrollera citattecknen.</translation>
        </message>
        <message>
            <source>The same at the front edge</source>
            <translation>Detsamma vid framkanten</translation>
        </message>
        <message>
            <source>The same person stands in line {line}.</source>
            <translation>Samma person står på rad {line}.</translation>
        </message>
        <message>
            <source>The sample patient cannot be merged with anybody; remove it.</source>
            <translation>Provpatienten kan inte slås ihop med någon; ta bort den.</translation>
        </message>
        <message>
            <source>The sample patient keeps its name and pseudonym, so that nobody takes it for a real patient.</source>
            <translation>Provpatienten behåller sitt namn och sin pseudonym, så att ingen tar den för en verklig patient.</translation>
        </message>
        <message>
            <source>The scan does not show the toes.</source>
            <translation>Skanningen visar inte tårna.</translation>
        </message>
        <message>
            <source>The scan does not show the whole {part} of the foot, so it cannot be said how it is loaded; scan the whole sole.</source>
            <translation>Skanningen visar inte hela delen {part} av foten, så det går inte att säga hur den belastas; skanna hela sulan.</translation>
        </message>
        <message>
            <source>The scan is finer than a foot needs ({millions:.1f} million triangles); it was thinned out to one point every {pitch_mm:.1f} mm.</source>
            <translation>Skanningen är finare än en fot behöver ({millions:.1f} miljoner trianglar); den glesades ut till en punkt var {pitch_mm:.1f} mm.</translation>
        </message>
        <message>
            <source>The scan lies so far from the origin that its coordinates are rounded to steps of {step_mm:.2f} mm; export it near the origin.</source>
            <translation>Skanningen ligger så långt från origo att koordinaterna är avrundade till steg om {step_mm:.2f} mm; exportera den nära origo.</translation>
        </message>
        <message>
            <source>The scan of the {side} foot is that of the visit of {day}, used once more; scan the foot again if it has changed.</source>
            <translation>Skanningen av {side} fot är från besöket {day} och används en gång till; skanna foten igen om den har förändrats.</translation>
        </message>
        <message>
            <source>The scan shows no sole: the foot stood on something that was left out. A plane closes it, so the arch is not known; scan the foot from below as well, or design the arch by hand.</source>
            <translation>Skanningen visar ingen sula: foten stod på något som utelämnades. Ett plan sluter den, så valvet är inte känt; skanna foten även underifrån, eller forma valvet för hand.</translation>
        </message>
        <message>
            <source>The scan {path} has changed since this case was made; the case keeps the foot as it was, open the scan again if the new one is wanted.</source>
            <translation>Skanningen {path} har ändrats sedan fallet gjordes; fallet behåller foten som den var, öppna skanningen igen om den nya önskas.</translation>
        </message>
        <message>
            <source>The scan {path} is not there any more, or cannot be read; the case holds its own copy of the foot, so the work can go on.</source>
            <translation>Skanningen {path} finns inte längre, eller kan inte läsas; fallet har en egen kopia av foten, så arbetet kan fortsätta.</translation>
        </message>
        <message>
            <source>The screen {screen} does not answer; start Insole Studio at the desktop of the computer, as the user who is signed in there.</source>
            <translation>Skärmen {screen} svarar inte; starta Insole Studio vid datorns skrivbord, som den användare som är inloggad där.</translation>
        </message>
        <message>
            <source>The sensors of the views {first} and {second} stood in the same place ({apart_mm:.0f} mm apart); see that no view was recorded under two names.</source>
            <translation>Sensorerna för vyerna {first} och {second} stod på samma plats ({apart_mm:.0f} mm isär); se till att ingen vy spelades in under två namn.</translation>
        </message>
        <message>
            <source>The session is read</source>
            <translation>Sessionen är läst</translation>
        </message>
        <message>
            <source>The session says that it is a {side} foot, but the shape looks like a {shape_side} one; ask which foot it is, and correct "side" in {file} if need be.</source>
            <translation>Sessionen säger att det är en {side} fot, men formen ser ut som en {shape_side}; fråga vilken fot det är, och rätta ”side” i {file} vid behov.</translation>
        </message>
        <message>
            <source>The settings in {path} are damaged, so it is not known where the record is; start the window once to mend them, or name the record.</source>
            <translation>Inställningarna i {path} är skadade, så det är inte känt var journalen finns; starta fönstret en gång för att laga dem, eller ange journalen.</translation>
        </message>
        <message>
            <source>The shank of the cutter "{cutter}" is thicker than its edges, which are {flute:g} mm long, and must go {depth:.1f} mm deep beside walls; take a lower block or another cutter.</source>
            <translation>Skaftet på fräsen ”{cutter}” är tjockare än dess skär, som är {flute:g} mm långa, och måste gå {depth:.1f} mm djupt intill väggar; ta ett lägre block eller en annan fräs.</translation>
        </message>
        <message>
            <source>The shape does not tell left from right (a left foot, {left}, or a right one, {right}); say which foot it is.</source>
            <translation>Formen skiljer inte vänster från höger (en vänsterfot, {left}, eller en högerfot, {right}); ange vilken fot det är.</translation>
        </message>
        <message>
            <source>The shape does not tell left from right; taken as a {side} foot as asked.</source>
            <translation>Formen skiljer inte vänster från höger; tas som en {side} fot som angivet.</translation>
        </message>
        <message>
            <source>The shape looks like a {shape_side} foot ({reason}); take it as a {shape_side} one, or insist on {side}.</source>
            <translation>Formen ser ut som en {shape_side} fot ({reason}); ta den som en {shape_side} fot, eller håll fast vid {side}.</translation>
        </message>
        <message>
            <source>The shape looks like a {shape_side} foot ({reason}); taken as a {side} one by force.</source>
            <translation>Formen ser ut som en {shape_side} fot ({reason}); tas ändå som en {side}.</translation>
        </message>
        <message>
            <source>The shape of the imprint does not tell left from right; say which foot it is.</source>
            <translation>Avtryckets form skiljer inte vänster från höger; ange vilken fot det är.</translation>
        </message>
        <message>
            <source>The shoe is {length:.0f} mm long and {width:.0f} mm wide inside, as no shoe is; choose it again.</source>
            <translation>Skon är {length:.0f} mm lång och {width:.0f} mm bred invändigt, som ingen sko är; välj den igen.</translation>
        </message>
        <message>
            <source>The shoe {shoe} leaves {room:.0f} mm before the toes of this foot, and 10 to 15 mm are usual; check the size.</source>
            <translation>Skon {shoe} lämnar {room:.0f} mm framför den här fotens tår, och 10 till 15 mm är vanligt; kontrollera storleken.</translation>
        </message>
        <message>
            <source>The sole of this scan is flat, as weight makes it; how load moves can only be told from a foot that was scanned without weight on it.</source>
            <translation>Sulan i den här skanningen är platt, som av tyngd; hur belastningen flyttas kan bara sägas för en fot som skannades utan tyngd.</translation>
        </message>
        <message>
            <source>The solid is closed.</source>
            <translation>Kroppen är sluten.</translation>
        </message>
        <message>
            <source>The solid is open or inside out.</source>
            <translation>Kroppen är öppen eller ut och in.</translation>
        </message>
        <message>
            <source>The solid needs {needed} mm, and the block has {there} mm.</source>
            <translation>Kroppen behöver {needed} mm, och blocket har {there} mm.</translation>
        </message>
        <message>
            <source>The surface could not be fitted to the views; see whether a view is spoilt, and leave it out.</source>
            <translation>Ytan kunde inte passas in i vyerna; kontrollera om någon vy är förstörd och uteslut den.</translation>
        </message>
        <message>
            <source>The surface faces into the foot: it is an imprint whose rim was cut off, or a file that is inside out; say whether it is a foam box or a foot.</source>
            <translation>Ytan vetter in mot foten: det är ett avtryck vars kant har skurits bort, eller en fil som är ut och in; ange om det är en skumlåda eller en fot.</translation>
        </message>
        <message>
            <source>The surface has no proportions of a foot: {scanned_mm:.0f} mm long, {ball_mm:.0f} mm wide at the ball, {heel_mm:.0f} mm at the heel; check that the file holds one whole foot or its sole, and nothing else.</source>
            <translation>Ytan har inte en fots proportioner: {scanned_mm:.0f} mm lång, {ball_mm:.0f} mm bred över trampdynan, {heel_mm:.0f} mm över hälen; kontrollera att filen innehåller en hel fot eller dess sula, och inget annat.</translation>
        </message>
        <message>
            <source>The surface has no sole: nothing of it faces the ground; check that the scan shows the foot from below.</source>
            <translation>Ytan har ingen fotsula: inget av den vetter mot underlaget; kontrollera att skanningen visar foten underifrån.</translation>
        </message>
        <message>
            <source>The surface has no toes and no ankle, as a shoe last or a prosthetic foot; if it is a foot, say so.</source>
            <translation>Ytan har varken tår eller vrist, som en läst eller en protesfot; om det är en fot, ange det.</translation>
        </message>
        <message>
            <source>The surface is computed on a grid of {grid_mm:g} mm; {limit:g} is the most allowed.</source>
            <translation>Ytan beräknas på ett rutnät av {grid_mm:g} mm; {limit:g} är det mesta tillåtna.</translation>
        </message>
        <message>
            <source>The surface is flat, which is no foot; export the scan again.</source>
            <translation>Ytan är plan, vilket ingen fot är; exportera skanningen igen.</translation>
        </message>
        <message>
            <source>The surface is no foot by its shape: {scanned_mm:.0f} mm long, but {toe_mm:.0f} mm high where the toes would be, and feet are {usual_mm:.0f} mm there at most; check that the file holds one whole foot or its sole, and nothing else.</source>
            <translation>Ytan har inte formen av en fot: {scanned_mm:.0f} mm lång men {toe_mm:.0f} mm hög där tårna skulle vara, och fötter är högst {usual_mm:.0f} mm där; kontrollera att filen innehåller en hel fot eller dess sula och inget annat.</translation>
        </message>
        <message>
            <source>The surface is noisy, by about {noise_mm:.1f} mm; it was smoothed to be measured, and its measures are uncertain by as much.</source>
            <translation>Ytan brusar, med ungefär {noise_mm:.1f} mm; den jämnades ut för mätningen, och måtten är lika osäkra.</translation>
        </message>
        <message>
            <source>The surface is only {thickness_mm:.0f} mm thick on average at a length of {scanned_mm:.0f} mm, as if it were an insole; choose the scan of the foot.</source>
            <translation>Ytan är i genomsnitt bara {thickness_mm:.0f} mm tjock vid en längd av {scanned_mm:.0f} mm, som om den vore ett inlägg; välj skanningen av foten.</translation>
        </message>
        <message>
            <source>The surface is open; where nothing was measured it is continued smoothly.</source>
            <translation>Ytan är öppen; där inget mättes fortsätts den mjukt.</translation>
        </message>
        <message>
            <source>The surface is ready</source>
            <translation>Ytan är klar</translation>
        </message>
        <message>
            <source>The surface is {length_mm:.0f} mm long.</source>
            <translation>Ytan är {length_mm:.0f} mm lång.</translation>
        </message>
        <message>
            <source>The surface looks like no foot, whichever way it is turned; check that the file holds a foot or its sole, and nothing else.</source>
            <translation>Ytan liknar ingen fot, hur den än vrids; kontrollera att filen innehåller en fot eller dess sula, och inget annat.</translation>
        </message>
        <message>
            <source>The surface shows {scanned_mm:.0f} mm of a foot without its toes, which fits no foot of {least_mm:g} to {most_mm:g} mm; check its unit, and that it is a foot.</source>
            <translation>Ytan visar {scanned_mm:.0f} mm av en fot utan tår, vilket inte passar någon fot på {least_mm:g} till {most_mm:g} mm; kontrollera enheten och att det är en fot.</translation>
        </message>
        <message>
            <source>The surface was inside out and has been turned.</source>
            <translation>Ytan var ut och in och har vänts.</translation>
        </message>
        <message>
            <source>The surface would be a foot of {length_mm:.0f} mm, and feet are {least_mm:g} to {most_mm:g} mm long; check its unit, and that it is a whole foot.</source>
            <translation>Ytan skulle vara en fot på {length_mm:.0f} mm, och fötter är {least_mm:g} till {most_mm:g} mm långa; kontrollera enheten, och att det är en hel fot.</translation>
        </message>
        <message>
            <source>The system lacks the library {name}; install Insole Studio by its package, which brings all that it needs, or ask whoever looks after this computer for that library.</source>
            <translation>Systemet saknar biblioteket {name}; installera Insole Studio med dess paket, som har med allt det behöver, eller be den som sköter datorn om biblioteket.</translation>
        </message>
        <message>
            <source>The table has {count} columns, and {mapped} are chosen; choose the columns anew.</source>
            <translation>Tabellen har {count} kolumner och {mapped} är valda; välj kolumnerna på nytt.</translation>
        </message>
        <message>
            <source>The table needs at least one material; add one.</source>
            <translation>Tabellen behöver minst ett material; lägg till ett.</translation>
        </message>
        <message>
            <source>The table of presets has no "{name}"; choose one of {known}.</source>
            <translation>Tabellen över utskrifter har ingen ”{name}”; välj en av {known}.</translation>
        </message>
        <message>
            <source>The texture {picture} is not beside the scan or cannot be read; the scan has no colours there.</source>
            <translation>Texturen {picture} ligger inte bredvid skanningen eller kan inte läsas; skanningen har inga färger där.</translation>
        </message>
        <message>
            <source>The tip of the 2nd toe does not stand out; the foot axis runs to its usual place.</source>
            <translation>2:a tåns spets framträder inte; fotaxeln går till dess vanliga plats.</translation>
        </message>
        <message>
            <source>The toes are missing; the foot's length is a guess from the rest.</source>
            <translation>Tårna saknas; fotens längd är en gissning utifrån resten.</translation>
        </message>
        <message>
            <source>The toes seem to be missing, so that the length of the foot is not known: {surface_mm:.0f} mm of it were scanned. Scan the foot with its toes, or give its length.</source>
            <translation>Tårna tycks saknas, så fotens längd är inte känd: {surface_mm:.0f} mm av den skannades. Skanna foten med tårna, eller ange dess längd.</translation>
        </message>
        <message>
            <source>The tolerance is {tolerance:g} mm, but must be above 0 and below the radius.</source>
            <translation>Toleransen är {tolerance:g} mm men måste vara större än 0 och mindre än radien.</translation>
        </message>
        <message>
            <source>The transition to the rim is {used_mm:.0f} mm wide {where} instead of {asked_mm:.0f} mm, or the wall would be too steep or bent too sharply; a rim nearer to the foot needs less.</source>
            <translation>Övergången till randen är {used_mm:.0f} mm bred {where} i stället för {asked_mm:.0f} mm, annars skulle väggen bli för brant eller för skarpt böjd; en rand närmare foten behöver mindre.</translation>
        </message>
        <message>
            <source>The transition to the rim of {asked_mm:.0f} mm has no room {where}, where the insole is {width_mm:.0f} mm wide: it is {used_mm:.0f} mm there; set a narrower transition.</source>
            <translation>Övergången till randen på {asked_mm:.0f} mm får inte plats {where}, där inlägget är {width_mm:.0f} mm brett: den är {used_mm:.0f} mm där; ställ in en smalare övergång.</translation>
        </message>
        <message>
            <source>The trim line crosses the edge of the insole {count} times, and must cross it once on either side; even out its points.</source>
            <translation>Klipplinjen korsar inläggets kant {count} gånger, och måste korsa den en gång på varje sida; jämna ut dess punkter.</translation>
        </message>
        <message>
            <source>The trim line does not cross the insole; move its points onto the insole, behind the metatarsal heads.</source>
            <translation>Klipplinjen korsar inte inlägget; flytta dess punkter in på inlägget, bakom metatarsalhuvudena.</translation>
        </message>
        <message>
            <source>The trim line leaves only {left_mm:.0f} mm of the insole, and a shell needs {least_mm:.0f} mm; move it towards the toes.</source>
            <translation>Klipplinjen lämnar bara {left_mm:.0f} mm av inlägget, och ett skal behöver {least_mm:.0f} mm; flytta den mot tårna.</translation>
        </message>
        <message>
            <source>The trim line runs through the {pad}; move the line ahead of it, or the pad behind the line.</source>
            <translation>Klipplinjen går genom elementet ({pad}); flytta linjen framför det, eller elementet bakom linjen.</translation>
        </message>
        <message>
            <source>The trim line turns back or crosses itself at its point {number}, counted from the medial border; let every point lie at least {least_mm:g} mm farther lateral than the one before.</source>
            <translation>Klipplinjen vänder tillbaka eller korsar sig själv vid punkt {number}, räknad från medialkanten; låt varje punkt ligga minst {least_mm:g} mm längre lateralt än den föregående.</translation>
        </message>
        <message>
            <source>The two lines are not the same; type both again.</source>
            <translation>De två raderna är inte lika; skriv båda igen.</translation>
        </message>
        <message>
            <source>The two points are too near to each other for a scale; click two that are far apart.</source>
            <translation>De två punkterna ligger för nära varandra för en skala; klicka på två som ligger långt isär.</translation>
        </message>
        <message>
            <source>The two points of the known distance coincide; set them apart.</source>
            <translation>De två punkterna för det kända avståndet sammanfaller; sätt dem isär.</translation>
        </message>
        <message>
            <source>The two surfaces do not overlap in any pose, so they cannot be compared; check that both show the same side of the same foot.</source>
            <translation>De två ytorna överlappar inte i något läge, så de kan inte jämföras; kontrollera att båda visar samma sida av samma fot.</translation>
        </message>
        <message>
            <source>The two surfaces lie over each other on {area_mm2:.0f} mm² only, which is too little to compare; let them be fitted, or pick points on both.</source>
            <translation>De två ytorna ligger över varandra på bara {area_mm2:.0f} mm², vilket är för lite för att jämföra; låt dem passas, eller välj punkter på båda.</translation>
        </message>
        <message>
            <source>The underside has other lettering already, or is not flat.</source>
            <translation>Undersidan har redan annan text, eller är inte plan.</translation>
        </message>
        <message>
            <source>The user {user} of the system has the account {account} already; choose one of both.</source>
            <translation>Systemets användare {user} har redan kontot {account}; välj ett av dem.</translation>
        </message>
        <message>
            <source>The view {view} cannot be used: {reason}; record it again.</source>
            <translation>Vyn {view} kan inte användas: {reason}; spela in den igen.</translation>
        </message>
        <message>
            <source>The view {view} is left out: {reason}.</source>
            <translation>Vyn {view} utelämnas: {reason}.</translation>
        </message>
        <message>
            <source>The view {view} is named twice; name every view once.</source>
            <translation>Vyn {view} anges två gånger; ange varje vy en gång.</translation>
        </message>
        <message>
            <source>The views {first} and {second} do not fit each other by {apart_mm:.0f} mm; see whether the foot or the reference system was moved between them.</source>
            <translation>Vyerna {first} och {second} skiljer sig {apart_mm:.0f} mm; se om foten eller referenssystemet flyttades mellan dem.</translation>
        </message>
        <message>
            <source>The views {first} and {second} name one camera, {serial}, in two places; unless it was moved between them, give each view the sensor.json of its own camera.</source>
            <translation>Vyerna {first} och {second} anger en och samma kamera, {serial}, på två platser; om den inte flyttades emellan ska varje vy få sensor.json från sin egen kamera.</translation>
        </message>
        <message>
            <source>The views {views} are both given to sensor {serial}, which cannot take them at the same time; give each view its own sensor, or capture one after the other.</source>
            <translation>Vyerna {views} är båda tilldelade sensor {serial}, som inte kan ta dem samtidigt; ge varje vy sin egen sensor, eller ta dem efter varandra.</translation>
        </message>
        <message>
            <source>The visit is open at the moment: {who}; close it there before it is deleted.</source>
            <translation>Besöket är öppet just nu: {who}; stäng det där innan det tas bort.</translation>
        </message>
        <message>
            <source>The visit of {day} has {fields}, and is kept; clear this under “Edit…” first if it was made by mistake.</source>
            <translation>Besöket den {day} har {fields} och finns kvar; töm det under ”Redigera…” först om det skapades av misstag.</translation>
        </message>
        <message>
            <source>The visit of {day} holds scans ({scans}), photos ({photos}), versions of prescriptions ({versions}), orders ({orders}) or follow-ups ({follow_ups}), and is kept; only an empty visit can be deleted.</source>
            <translation>Besöket den {day} innehåller skanningar ({scans}), foton ({photos}), versioner av ordinationer ({versions}), beställningar ({orders}) eller uppföljningar ({follow_ups}) och finns kvar; bara ett tomt besök kan tas bort.</translation>
        </message>
        <message>
            <source>The volume of interest was set by hand.</source>
            <translation>Volymen av intresse sattes för hand.</translation>
        </message>
        <message>
            <source>The wall shows another pattern (likeness {likeness:.2f}); it is of another sensor, or no flat wall; else learn the reference again.</source>
            <translation>Väggen visar ett annat mönster (likhet {likeness:.2f}); den är av en annan sensor, eller ingen plan vägg; lär annars in mönstret på nytt.</translation>
        </message>
        <message>
            <source>The wall to the rim is {angle:.0f}° steep, and there is no room for a wider one; lower the rim there.</source>
            <translation>Väggen till randen lutar {angle:.0f}°, och det finns ingen plats för en bredare; sänk randen där.</translation>
        </message>
        <message>
            <source>The wall was not kept, because sensor or wall moved, or its infrared pictures are black or saturated; hold the sensor still with its emitter uncovered, and take it again.</source>
            <translation>Väggen sparades inte, eftersom sensorn eller väggen rörde sig, eller dess infraröda bilder är svarta eller mättade; håll sensorn stilla med strålkastaren fri och ta väggen igen.</translation>
        </message>
        <message>
            <source>The walls are still off by {rms_raw:.1f} raw units, which is more than noise, as with boards held before a wall; capture flat, empty walls, with the sensor standing still.</source>
            <translation>Väggarna avviker ännu {rms_raw:.1f} råenheter, vilket är mer än brus, som när bräden hålls framför en vägg; ta plana, tomma väggar, med sensorn stilla.</translation>
        </message>
        <message>
            <source>The walls contradict each other ({walls}); capture a flat, empty wall at several distances.</source>
            <translation>Väggarna motsäger varandra ({walls}); ta en plan, tom vägg på flera avstånd.</translation>
        </message>
        <message>
            <source>The walls of {folder} were recorded with sensor {found}, but the calibration is of sensor {serial}; name the walls of that sensor.</source>
            <translation>Väggarna i {folder} spelades in med sensor {found}, men kalibreringen är av sensor {serial}; ange den sensorns väggar.</translation>
        </message>
        <message>
            <source>The walls were off by {before_raw:.1f} raw units and are now off by {after_raw:.1f} (noise included).</source>
            <translation>Väggarna avvek {before_raw:.1f} råenheter och avviker nu {after_raw:.1f} (inklusive brus).</translation>
        </message>
        <message>
            <source>The warm-up needs three moments with readings; record for 15 minutes.</source>
            <translation>Uppvärmningen behöver tre tidpunkter med mätvärden; spela in i 15 minuter.</translation>
        </message>
        <message>
            <source>The zone {zone} does not lie on the {side} insole; leave it out.</source>
            <translation>Zonen {zone} ligger inte på inlägget ({side}); utelämna den.</translation>
        </message>
        <message>
            <source>The zone {zone} is a layer that the design does not have; give the layer a thickness or leave the zone out.</source>
            <translation>Zonen {zone} är ett lager som designen inte har; ge lagret en tjocklek eller utelämna zonen.</translation>
        </message>
        <message>
            <source>The zone {zone} is thinner than two walls ({least:g} mm), so no infill finds room in it; make it larger or leave it out.</source>
            <translation>Zonen {zone} är tunnare än två väggar ({least:g} mm), så ingen fyllning får plats i den; gör den större eller utelämna den.</translation>
        </message>
        <message>
            <source>The zone {zone} needs a map of pressures under the {side} foot; lay one under it, or leave the zone out.</source>
            <translation>Zonen {zone} behöver en tryckkarta under foten ({side}); lägg in en, eller utelämna zonen.</translation>
        </message>
        <message>
            <source>The zones {first} and {second} overlap; there, {second} is obeyed.</source>
            <translation>Zonerna {first} och {second} överlappar; där gäller {second}.</translation>
        </message>
        <message>
            <source>The {count} frames show different scenes (they differ by {difference_raw:.0f} raw units); record one still wall without moving the sensor.</source>
            <translation>De {count} bilderna visar olika motiv (de skiljer {difference_raw:.0f} råenheter); spela in en stilla vägg utan att röra sensorn.</translation>
        </message>
        <message>
            <source>The {head} metatarsal head lies behind the heel; put it in place.</source>
            <translation>Metatarsalhuvudet {head} ligger bakom hälen; sätt det på plats.</translation>
        </message>
        <message>
            <source>The {kind} pictures are {width}×{height}, but the sensor gives {allowed}; use its pictures as they are, neither cut nor scaled.</source>
            <translation>Bilderna ({kind}) är {width}×{height}, men sensorn ger {allowed}; använd dess bilder som de är, varken beskurna eller skalade.</translation>
        </message>
        <message>
            <source>The {kind} was said to be {said} in diameter, but {found_mm:.1f} mm was measured (up to {tolerance_mm:.1f} mm off is put down to the sensors); measure it again, or calibrate the sensors.</source>
            <translation>Föremålet ({kind}) uppgavs ha diametern {said}, men {found_mm:.1f} mm uppmättes (upp till {tolerance_mm:.1f} mm avvikelse tillskrivs sensorerna); mät det igen, eller kalibrera sensorerna.</translation>
        </message>
        <message>
            <source>The {name} of the order has {count} characters, and the papers take at most {most}; shorten it.</source>
            <translation>Beställningens fält {name} har {count} tecken, och papperen rymmer högst {most}; korta det.</translation>
        </message>
        <message>
            <source>The {pad} comes within {distance_mm:g} mm of the 1st head, which it leaves free; keep it at least {least_mm:g} mm away.</source>
            <translation>Avståndet ({pad}) till första metatarsalhuvudet, som ska vara fritt, är {distance_mm:g} mm; håll det minst {least_mm:g} mm bort.</translation>
        </message>
        <message>
            <source>The {pad} is {depth_mm:g} mm deep; up to {usual_mm:g} mm are usual.</source>
            <translation>Djupet ({pad}) är {depth_mm:g} mm; upp till {usual_mm:g} mm är vanligt.</translation>
        </message>
        <message>
            <source>The {pad} is {height_mm:g} mm high; up to {usual_mm:g} mm are usual.</source>
            <translation>Höjden ({pad}) är {height_mm:g} mm; upp till {usual_mm:g} mm är vanligt.</translation>
        </message>
        <message>
            <source>The {pad} lies ahead of the trim line and is not made; move the line ahead of it, or choose the full length.</source>
            <translation>Elementet ({pad}) ligger framför klipplinjen och görs inte; flytta linjen framför det, eller välj full längd.</translation>
        </message>
        <message>
            <source>The {pad} lies with {share:.0%} on the {other_pad}, and their heights add up.</source>
            <translation>Elementet ({pad}) ligger till {share:.0%} på ett annat ({other_pad}), och höjderna läggs ihop.</translation>
        </message>
        <message>
            <source>The {pad} reaches {over:.0f} mm beyond the shoe {shoe} and is cut there; move it or make it smaller.</source>
            <translation>Elementet {pad} når {over:.0f} mm utanför skon {shoe} och skärs av där; flytta det eller gör det mindre.</translation>
        </message>
        <message>
            <source>The {pad} stands {height_mm:g} mm out of the insole and presses instead of relieving; set a depth above 0.</source>
            <translation>Elementet ({pad}) sticker upp {height_mm:g} mm ur inlägget och trycker i stället för att avlasta; ange ett djup över 0.</translation>
        </message>
        <message>
            <source>The {side} foot has the shape of a {other} one; check which foot was scanned, and if the side is wrong, open the scan again as the {other} foot.</source>
            <translation>Foten ({side}) har den andra fotens form ({other}); kontrollera vilken fot som skannades, och öppna skanningen igen som den andra foten om sidan är fel.</translation>
        </message>
        <message>
            <source>The {side} foot is asked for, but {path} was recorded as the {recorded} foot; ask for that one, or name the recording of the other.</source>
            <translation>{side} fot begärs, men {path} spelades in som {recorded} fot; begär den, eller ange inspelningen av den andra.</translation>
        </message>
        <message>
            <source>The {side} foot reaches out of its volume, so part of it is missing or of the other foot; put each foot in the middle of its place, where they neither touch nor cross, and capture them again.</source>
            <translation>Foten på {side} sida når ut ur sin volym, så att en del av den saknas eller hör till den andra foten; ställ varje fot i mitten av sin plats, där de varken rör vid eller korsar varandra, och avbilda dem igen.</translation>
        </message>
        <message>
            <source>The {side} foot was changed while the map was being aligned to it, so the map was not laid; lay it again.</source>
            <translation>Foten ({side}) ändrades medan bilden passades in under den, så bilden lades inte dit; lägg den igen.</translation>
        </message>
        <message>
            <source>The {side} foot was not scanned: foot and insole are mirrored from the {other} foot.</source>
            <translation>Foten ({side}) är inte skannad: fot och inlägg är speglade från den andra foten ({other}).</translation>
        </message>
        <message>
            <source>The {side} foot: {reason}</source>
            <translation>Foten på {side} sida: {reason}</translation>
        </message>
        <message>
            <source>The {side} foot: {step}</source>
            <translation>Foten på {side} sida: {step}</translation>
        </message>
        <message>
            <source>The {side} insole has no pad {zone}; its pads are: {names}.</source>
            <translation>Inlägget ({side}) har ingen pelott {zone}; de som finns är: {names}.</translation>
        </message>
        <message>
            <source>The {side} insole has no pad, so there is no zone {zone}; leave it out.</source>
            <translation>Inlägget ({side}) har ingen pelott, så zonen {zone} finns inte; utelämna den.</translation>
        </message>
        <message>
            <source>The {what} cannot be right: {reason}</source>
            <translation>{what} kan inte stämma: {reason}</translation>
        </message>
        <message>
            <source>The {what} cannot be {value:g}; choose a value from {least:g} to {most:g}.</source>
            <translation>{what} kan inte vara {value:g}; välj ett värde från {least:g} till {most:g}.</translation>
        </message>
        <message>
            <source>The {what} has {count} characters, and may have {most}; shorten it.</source>
            <translation>{what} har {count} tecken och får ha {most}; korta texten.</translation>
        </message>
        <message>
            <source>The {what} holds a character that cannot be seen (U+{code}) after “{before}”; delete it.</source>
            <translation>{what} innehåller ett tecken som inte syns (U+{code}) efter ”{before}”; ta bort det.</translation>
        </message>
        <message>
            <source>The {what} holds the patient's name, which the shop must not get; use the pseudonym or an order number in its place.</source>
            <translation>{what} innehåller patientens namn, som verkstaden inte får; använd pseudonymen eller ett ordernummer i stället.</translation>
        </message>
        <message>
            <source>The {what} is missing; type one.</source>
            <translation>{what} saknas; fyll i fältet.</translation>
        </message>
        <message>
            <source>The {what} is one of: {names}; {word} is none of them.</source>
            <translation>Fältet {what} är ett av: {names}; {word} är inget av dem.</translation>
        </message>
        <message>
            <source>The {what} is that of {name}, {born}; name or birth date differ.</source>
            <translation>Uppgiften {what} tillhör {name}, {born}; namn eller födelsedatum skiljer sig.</translation>
        </message>
        <message>
            <source>The {what} is {value:g} mm, and it must be {low:g} to {high:g} mm.</source>
            <translation>Värdet {value:g} mm kan inte stämma ({what}); det måste vara {low:g} till {high:g} mm.</translation>
        </message>
        <message>
            <source>The {what} must be between {least:g} and {most:g}, not {value:g}.</source>
            <translation>{what} måste vara mellan {least:g} och {most:g}, inte {value:g}.</translation>
        </message>
        <message>
            <source>The {what} {day} is not between {first} and {last}; check the year.</source>
            <translation>{what} {day} ligger inte mellan {first} och {last}; kontrollera året.</translation>
        </message>
        <message>
            <source>There are no captures; capture a flat wall.</source>
            <translation>Det finns inga tagningar; ta en plan vägg.</translation>
        </message>
        <message>
            <source>There is a block {name} already; give this one another name.</source>
            <translation>Det finns redan ett block {name}; ge detta ett annat namn.</translation>
        </message>
        <message>
            <source>There is a material {name} already; give this one another name.</source>
            <translation>Det finns redan ett material {name}; ge det här ett annat namn.</translation>
        </message>
        <message>
            <source>There is a variant {name} already; give this one another name.</source>
            <translation>Det finns redan en variant {name}; ge denna ett annat namn.</translation>
        </message>
        <message>
            <source>There is an account {account} already; choose another name.</source>
            <translation>Det finns redan ett konto {account}; välj ett annat namn.</translation>
        </message>
        <message>
            <source>There is an order {number} already; give this one another number.</source>
            <translation>Det finns redan en beställning {number}; ge den här ett annat nummer.</translation>
        </message>
        <message>
            <source>There is no account {name}; look at the list of accounts.</source>
            <translation>Det finns inget konto {name}; se listan över konton.</translation>
        </message>
        <message>
            <source>There is no copy {name} of the record; choose one that is.</source>
            <translation>Det finns ingen kopia {name} av journalen; välj en som finns.</translation>
        </message>
        <message>
            <source>There is no device "{name}"; choose one of {known}.</source>
            <translation>Det finns inget inlägg "{name}"; välj ett av {known}.</translation>
        </message>
        <message>
            <source>There is no finding "{name}"; choose one of {known}.</source>
            <translation>Det finns inget fynd "{name}"; välj ett av {known}.</translation>
        </message>
        <message>
            <source>There is no folder {folder}; name the folder with the infrared pictures of walls.</source>
            <translation>Det finns ingen mapp {folder}; ange mappen med de infraröda bilderna av väggar.</translation>
        </message>
        <message>
            <source>There is no folder {folder}; name the folder with the pictures.</source>
            <translation>Mappen {folder} finns inte; ange mappen med bilderna.</translation>
        </message>
        <message>
            <source>There is no folder {folder}; name the folder with the wall captures.</source>
            <translation>Mappen {folder} finns inte; ange mappen med tagningarna av väggen.</translation>
        </message>
        <message>
            <source>There is no foot with measures of its own: a mirror image has none; open a scan of the foot first.</source>
            <translation>Det finns ingen fot med egna mått: en spegelbild har inga; öppna först en skanning av foten.</translation>
        </message>
        <message>
            <source>There is no frame {number}; choose one from 1 to {count}.</source>
            <translation>Det finns ingen bild {number} i serien; välj en från 1 till {count}.</translation>
        </message>
        <message>
            <source>There is no kind of personal number {kind}; choose one.</source>
            <translation>Det finns inget slags personnummer {kind}; välj ett.</translation>
        </message>
        <message>
            <source>There is no machine {name}; there are {known}. Choose one, or name a machine file.</source>
            <translation>Det finns ingen maskin {name}; det finns {known}. Välj en av dem, eller ange en maskinfil.</translation>
        </message>
        <message>
            <source>There is no marker dictionary {dictionary}; the printed board of this program uses DICT_5X5_250.</source>
            <translation>Markörförteckningen {dictionary} finns inte; programmets utskrivna bräde använder DICT_5X5_250.</translation>
        </message>
        <message>
            <source>There is no order {number} in the record; check the number.</source>
            <translation>Det finns ingen beställning {number} i journalen; kontrollera numret.</translation>
        </message>
        <message>
            <source>There is no screen to open a window on; start Insole Studio at the desktop of the computer. What works without one says insole-studio --help.</source>
            <translation>Det finns ingen skärm att öppna ett fönster på; starta Insole Studio vid datorns skrivbord. Vad som fungerar utan säger insole-studio --help.</translation>
        </message>
        <message>
            <source>There is no size {size:g} in {system}, which goes from {least:g} to {greatest:g}; check size and system.</source>
            <translation>Det finns ingen storlek {size:g} i {system}, som går från {least:g} till {greatest:g}; kontrollera storlek och system.</translation>
        </message>
        <message>
            <source>There is no step {number}; choose one from 1 to {count}.</source>
            <translation>Det finns inget steg {number}; välj ett från 1 till {count}.</translation>
        </message>
        <message>
            <source>There is no such account any more; look at the list again.</source>
            <translation>Kontot finns inte längre; titta i listan igen.</translation>
        </message>
        <message>
            <source>There is no system of shoe sizes "{name}"; there are {known}.</source>
            <translation>Det finns inget system för skostorlekar som heter ”{name}”; det finns {known}.</translation>
        </message>
        <message>
            <source>There is no width "{width}" of a shoe; there are {known}.</source>
            <translation>Det finns ingen skobredd ”{width}”; det finns {known}.</translation>
        </message>
        <message>
            <source>There is nobody to erase with the pseudonym {pseudonym}; it stands on the patient's page.</source>
            <translation>Det finns ingen att radera med pseudonymen {pseudonym}; den står på patientens sida.</translation>
        </message>
        <message>
            <source>There is nothing to nest; name at least one order.</source>
            <translation>Det finns inget att lägga ut; ange minst en beställning.</translation>
        </message>
        <message>
            <source>There is somebody of this name, {born}, and a birth date is missing to tell whether it is the same person.</source>
            <translation>Det finns någon med detta namn, {born}, och det saknas ett födelsedatum för att avgöra om det är samma person.</translation>
        </message>
        <message>
            <source>There is somebody with this name and birth date, and another personal number.</source>
            <translation>Det finns någon med detta namn och födelsedatum men ett annat personnummer.</translation>
        </message>
        <message>
            <source>Thesis 3.3: the contact surface as it was measured, without a designed rim</source>
            <translation>Avhandlingen 3.3: kontaktytan som den mättes, utan utformad kant</translation>
        </message>
        <message>
            <source>Thickness</source>
            <translation>Tjocklek</translation>
        </message>
        <message>
            <source>Thickness below which it is warned of; the material's if left out</source>
            <translation>Tjocklek under vilken det varnas; materialets om den utelämnas</translation>
        </message>
        <message>
            <source>Thickness of the layer between cover and base; 0 for none</source>
            <translation>Tjocklek på lagret mellan överdrag och bas; 0 för inget</translation>
        </message>
        <message>
            <source>Thickness of the layer next to the foot; 0 for none</source>
            <translation>Tjocklek på lagret närmast foten; 0 för inget</translation>
        </message>
        <message>
            <source>Thickness of the layer next to the shoe; 0 for none</source>
            <translation>Tjocklek på lagret närmast skon; 0 för inget</translation>
        </message>
        <message>
            <source>Thickness of the shell at its front edge</source>
            <translation>Skalets tjocklek vid framkanten</translation>
        </message>
        <message>
            <source>This account was disabled meanwhile; ask the administrator.</source>
            <translation>Kontot har spärrats under tiden; fråga administratören.</translation>
        </message>
        <message>
            <source>This capture is no longer in the record; open the visit again.</source>
            <translation>Den här avbildningen finns inte längre i journalen; öppna besöket igen.</translation>
        </message>
        <message>
            <source>This design has nothing beyond its device that a finding could propose; add a correction or a pad, or save it as a device.</source>
            <translation>Den här ordinationen har inget utöver sin inläggstyp som ett fynd kan föreslå; lägg till en korrigering eller en pelott, eller spara den som inläggstyp.</translation>
        </message>
        <message>
            <source>This design is for a {side} foot and the scan is of a {foot_side} one; open the matching scan or mirror the design.</source>
            <translation>Designen är för en {side} fot och skanningen är av en {foot_side}; öppna rätt skanning eller spegla designen.</translation>
        </message>
        <message>
            <source>This is the password that it had before; choose another one.</source>
            <translation>Det är samma lösenord som förut; välj ett annat.</translation>
        </message>
        <message>
            <source>This is the same person twice; choose another one to merge with.</source>
            <translation>Det är samma person två gånger; välj en annan att slå samman med.</translation>
        </message>
        <message>
            <source>This looks like the map of a {other} foot, and it was laid under the {side} one; check the side, and whether it is seen from above or below.</source>
            <translation>Detta ser ut som en annan fots tryckbild ({other}), och den lades under den här foten ({side}); kontrollera sidan, och om den är sedd uppifrån eller nerifrån.</translation>
        </message>
        <message>
            <source>This merge has been undone already; look at the persons again.</source>
            <translation>Den här sammanslagningen har redan ångrats; titta på personerna igen.</translation>
        </message>
        <message>
            <source>This order is no longer in the record; look at the list again.</source>
            <translation>Den här beställningen finns inte längre i journalen; titta i listan igen.</translation>
        </message>
        <message>
            <source>This person is no longer in the record; search for them again.</source>
            <translation>Den här personen finns inte längre i journalen; sök igen.</translation>
        </message>
        <message>
            <source>This person was merged with another one meanwhile; open the other one.</source>
            <translation>Den här personen har under tiden slagits samman med en annan; öppna den andra.</translation>
        </message>
        <message>
            <source>This person was merged with another one; erase the other one.</source>
            <translation>Personen har slagits ihop med en annan; radera den andra.</translation>
        </message>
        <message>
            <source>This photo is no longer in the record; open the photos again.</source>
            <translation>Fotot finns inte längre i journalen; öppna fotona igen.</translation>
        </message>
        <message>
            <source>This version is closed already; it stays as it is.</source>
            <translation>Den här versionen är redan avslutad; den förblir som den är.</translation>
        </message>
        <message>
            <source>This version is no longer in the record; open the history of the visit again.</source>
            <translation>Den här versionen finns inte längre i journalen; öppna besökets historik igen.</translation>
        </message>
        <message>
            <source>This version of the prescription is not in the record any more; look at its history.</source>
            <translation>Den här versionen av ordinationen finns inte längre i journalen; titta i dess historik.</translation>
        </message>
        <message>
            <source>This visit is no longer in the record; open the person again.</source>
            <translation>Det här besöket finns inte längre i journalen; öppna personen igen.</translation>
        </message>
        <message>
            <source>Tibialis posterior dysfunction, flexible</source>
            <translation>Tibialis posterior-dysfunktion, flexibel</translation>
        </message>
        <message>
            <source>Tilt rear- and forefoot by degrees, against pronation or supination</source>
            <translation>Luta bak- och framfot i grader, mot pronation eller supination</translation>
        </message>
        <message>
            <source>Tilt the forefoot</source>
            <translation>Luta framfoten</translation>
        </message>
        <message>
            <source>Tilt the rearfoot</source>
            <translation>Luta bakfoten</translation>
        </message>
        <message>
            <source>Tilting the sensor for view {view}</source>
            <translation>Lutar sensorn för vy {view}</translation>
        </message>
        <message>
            <source>Time, without changes of cutters</source>
            <translation>Tid, utan verktygsbyten</translation>
        </message>
        <message>
            <source>Tired arch</source>
            <translation>Trött fotvalv</translation>
        </message>
        <message>
            <source>To capture, plug in the USB cable of each sensor and its 12 V supply.</source>
            <translation>För att avbilda: anslut varje sensors USB-kabel och dess 12 V-matning.</translation>
        </message>
        <message>
            <source>To the toes, or to behind the metatarsal heads</source>
            <translation>Till tårna, eller till bakom metatarsalhuvudena</translation>
        </message>
        <message>
            <source>To watch</source>
            <translation>Att ge akt på</translation>
        </message>
        <message>
            <source>Toe line</source>
            <translation>Tålinje</translation>
        </message>
        <message>
            <source>Toe zone</source>
            <translation>Tåzon</translation>
        </message>
        <message>
            <source>Toes</source>
            <translation>Tår</translation>
        </message>
        <message>
            <source>Toes bend at push-off, and the model does not bend them.</source>
            <translation>Tårna böjs vid frånskjutet, och modellen böjer dem inte.</translation>
        </message>
        <message>
            <source>Tolerance</source>
            <translation>Tolerans</translation>
        </message>
        <message>
            <source>Too little of the solid is seen from above to check its {what}.</source>
            <translation>För lite av kroppen syns uppifrån för att kontrollera: {what}.</translation>
        </message>
        <message>
            <source>Too many wrong passwords: wait {minutes} min, or ask the administrator to unlock the account.</source>
            <translation>För många felaktiga lösenord: vänta {minutes} min, eller be administratören låsa upp kontot.</translation>
        </message>
        <message>
            <source>Total contact, cup 8 to 12, low rounded rim without a hard edge, fill 0, base of at least 4.8, Shore A 35 (Noridian A5513), reliefs for each head (SureFit)</source>
            <translation>Helkontakt, hälskål 8 till 12, låg rundad kant utan hårda kanter, fyllnad 0, bas på minst 4,8, Shore A 35 (Noridian A5513), avlastning för varje metatarsalhuvud (SureFit)</translation>
        </message>
        <message>
            <source>Triangles</source>
            <translation>Trianglar</translation>
        </message>
        <message>
            <source>Trim line</source>
            <translation>Klipplinje</translation>
        </message>
        <message>
            <source>Trimmed to it</source>
            <translation>Skuren efter den</translation>
        </message>
        <message>
            <source>Trimming the insole</source>
            <translation>Beskär inlägget</translation>
        </message>
        <message>
            <source>Trying poses</source>
            <translation>Prövar lägen</translation>
        </message>
        <message>
            <source>Turkish</source>
            <translation>Turkisk</translation>
        </message>
        <message>
            <source>Turn</source>
            <translation>Vridning</translation>
        </message>
        <message>
            <source>Turn seen from above; &gt; 0 is counter-clockwise</source>
            <translation>Vridning sedd uppifrån; &gt; 0 är moturs</translation>
        </message>
        <message>
            <source>Turn the board strongly, by 40 to 55°: {sides}.</source>
            <translation>Vrid brädet kraftigt, 40 till 55°: {sides}.</translation>
        </message>
        <message>
            <source>Turn the forefoot against the rearfoot</source>
            <translation>Vrid framfoten mot bakfoten</translation>
        </message>
        <message>
            <source>Turn the pad</source>
            <translation>Vrid pelotten</translation>
        </message>
        <message>
            <source>Turned about</source>
            <translation>Vänds runt</translation>
        </message>
        <message>
            <source>Turning the foot and shaping the heel</source>
            <translation>Vrider foten och formar hälen</translation>
        </message>
        <message>
            <source>Two columns hold the {field}; choose one of them.</source>
            <translation>Två kolumner innehåller samma uppgift, {field}; välj en av dem.</translation>
        </message>
        <message>
            <source>Two files of the order have the name {name}; give one another name.</source>
            <translation>Två filer i beställningen heter {name}; ge en av dem ett annat namn.</translation>
        </message>
        <message>
            <source>Two patients of the order are called {pseudonym}; give one of them another pseudonym.</source>
            <translation>Två patienter i beställningen heter {pseudonym}; ge en av dem en annan pseudonym.</translation>
        </message>
        <message>
            <source>Two points of the object have the same true position; correct the list.</source>
            <translation>Två punkter på föremålet har samma sanna läge; rätta listan.</translation>
        </message>
        <message>
            <source>Two stations of the rim lie at the same place {where}, one {height_mm:.1f} mm high and one {other_mm:.1f} mm; remove one of them.</source>
            <translation>Två stationer på randen ligger på samma plats {where}, en {height_mm:.1f} mm hög och en {other_mm:.1f} mm; ta bort en av dem.</translation>
        </message>
        <message>
            <source>Type the address of the database, or use the record of this computer.</source>
            <translation>Skriv databasens adress eller använd journalen på den här datorn.</translation>
        </message>
        <message>
            <source>UCBL</source>
            <translation>UCBL</translation>
        </message>
        <message>
            <source>UCBL, child</source>
            <translation>UCBL, barn</translation>
        </message>
        <message>
            <source>UK child</source>
            <translation>UK barn</translation>
        </message>
        <message>
            <source>US men</source>
            <translation>US herr</translation>
        </message>
        <message>
            <source>US women</source>
            <translation>US dam</translation>
        </message>
        <message>
            <source>Unchanged: {files}; all that {order} says (quantities, materials, texts, dates, names of programs); the terms on {sheets}.</source>
            <translation>Oförändrat: {files}; allt som {order} säger (antal, material, texter, datum, programnamn); villkoren på {sheets}.</translation>
        </message>
        <message>
            <source>Unchanged: {files}; the terms on {sheets}. {order} was written by an earlier version of the program, without a digest of its own: compare quantities, materials and texts with what the clinic has sent.</source>
            <translation>Oförändrat: {files}; villkoren på {sheets}. {order} skrevs av en tidigare version av programmet, utan egen kontrollsumma: jämför antal, material och texter med det som kliniken har skickat.</translation>
        </message>
        <message>
            <source>Underside</source>
            <translation>Undersida</translation>
        </message>
        <message>
            <source>Units</source>
            <translation>Enheter</translation>
        </message>
        <message>
            <source>Unsteady heel</source>
            <translation>Ostadig häl</translation>
        </message>
        <message>
            <source>Unusual in the design</source>
            <translation>Ovanligt i utformningen</translation>
        </message>
        <message>
            <source>Up to 10 in the shoe; above 6.4 under the full sole, half of it at the heads.</source>
            <translation>Upp till 10 i skon; över 6,4 under hela sulan, hälften vid huvudena.</translation>
        </message>
        <message>
            <source>Value</source>
            <translation>Värde</translation>
        </message>
        <message>
            <source>Verifying the audit log</source>
            <translation>Kontrollerar loggen</translation>
        </message>
        <message>
            <source>Verifying the files of the record</source>
            <translation>Kontrollerar journalens filer</translation>
        </message>
        <message>
            <source>Verifying {count} signatures</source>
            <translation>Kontrollerar {count} signaturer</translation>
        </message>
        <message>
            <source>Version</source>
            <translation>Version</translation>
        </message>
        <message>
            <source>View {views} is on the disk</source>
            <translation>Vy {views} finns på disken</translation>
        </message>
        <message>
            <source>View {view} has colour images of {width}×{height}, but the sensor was calibrated at {known_width}×{known_height}; calibrate its colour camera with pictures of that size.</source>
            <translation>Vyn {view} har färgbilder på {width}×{height}, men sensorn kalibrerades vid {known_width}×{known_height}; kalibrera dess färgkamera med bilder av den storleken.</translation>
        </message>
        <message>
            <source>View {view} measured depth in only {share:.1%} of its picture; check that it is far enough from the foot and not covered, and capture this view again.</source>
            <translation>Vyn {view} mätte djup i bara {share:.1%} av sin bild; kontrollera att sensorn är tillräckligt långt från foten och inte täckt, och ta vyn igen.</translation>
        </message>
        <message>
            <source>View {view} stays as it was recorded, because its sensor {serial}, a {model}, delivers millimetres and was not calibrated here; calibrate it with walls.</source>
            <translation>Vyn {view} förblir som den spelades in, eftersom dess sensor {serial}, en {model}, levererar millimeter och inte har kalibrerats här; kalibrera den med väggar.</translation>
        </message>
        <message>
            <source>View {view} was recorded with sensor {serial}, which was never calibrated here; calibrate it first.</source>
            <translation>Vyn {view} spelades in med sensor {serial}, som aldrig kalibrerats här; kalibrera den först.</translation>
        </message>
        <message>
            <source>View {view}: its infrared pictures lie {drift:.2f} px off the sensor's own depth, though nothing moved between the two, so the sensor's pattern of dots has drifted. Its own depth was taken for the distance of the whole; learn the pattern again by calibrate infrared.</source>
            <translation>Vy {view}: dess infraröda bilder ligger {drift:.2f} px från sensorns eget djup, fast inget rörde sig mellan de två, så sensorns punktmönster har drivit. Dess eget djup fick avgöra avståndet i stort; lär in mönstret igen med calibrate infrared.</translation>
        </message>
        <message>
            <source>View {view}: its infrared pictures lie {drift:.2f} px off the sensor's own depth, which was taken for the distance of the whole: the foot moved a little between the two, or the sensor has drifted. Take the view again; if it is told again, calibrate the sensor again, the pattern of a Kinect by calibrate infrared.</source>
            <translation>Vy {view}: dess infraröda bilder ligger {drift:.2f} px från sensorns eget djup, som fick avgöra avståndet i stort: foten rörde sig lite mellan de två, eller så har sensorn drivit. Ta vyn igen; sägs det åter, kalibrera sensorn igen, en Kinects mönster med calibrate infrared.</translation>
        </message>
        <message>
            <source>View {view}: its infrared pictures show the pattern on {share:.0%} of the foot only, so they are of another moment, pose or sensor, or the pattern has drifted.</source>
            <translation>Vy {view}: dess infraröda bilder visar mönstret bara på {share:.0%} av foten, så de är av ett annat ögonblick, läge eller en annan sensor, eller så har mönstret flyttat sig.</translation>
        </message>
        <message>
            <source>View {view}: its infrared pictures were trusted on {share:.0%} of the foot; on the rest the sensor's own depth was used.</source>
            <translation>Vy {view}: dess infraröda bilder var att lita på på {share:.0%} av foten; på resten användes sensorns eget djup.</translation>
        </message>
        <message>
            <source>View {view}: the foot moved a little between its depth and its infrared pictures: depth changed by {moved:.2f} px. Hold the foot still, and take the view again.</source>
            <translation>Vy {view}: foten rörde sig lite mellan vyns djup och dess infraröda bilder: djupet ändrades {moved:.2f} px. Håll foten stilla och ta vyn igen.</translation>
        </message>
        <message>
            <source>View {view}: {warning}</source>
            <translation>Vyn {view}: {warning}</translation>
        </message>
        <message>
            <source>Views {views}: {warning}</source>
            <translation>Vyerna {views}: {warning}</translation>
        </message>
        <message>
            <source>Visit</source>
            <translation>Besök</translation>
        </message>
        <message>
            <source>Visit on {day}</source>
            <translation>Besök {day}</translation>
        </message>
        <message>
            <source>Volume</source>
            <translation>Volym</translation>
        </message>
        <message>
            <source>Waiting for steady depth of view {views}</source>
            <translation>Väntar på stadigt djup i vy {views}</translation>
        </message>
        <message>
            <source>Waiting until the backup has stopped</source>
            <translation>Väntar tills säkerhetskopieringen har stannat</translation>
        </message>
        <message>
            <source>Walls and solid layers make the print denser than its infill ({zones}); where it has to be softer, take a preset with fewer of them, or make the insole thicker.</source>
            <translation>Väggar och täta lager gör utskriften tätare än dess fyllning ({zones}); där den måste vara mjukare, välj en utskrift med färre av dem, eller gör inlägget tjockare.</translation>
        </message>
        <message>
            <source>Weighing the print</source>
            <translation>Väger utskriften</translation>
        </message>
        <message>
            <source>Weight (kg)</source>
            <translation>Vikt (kg)</translation>
        </message>
        <message>
            <source>Western European</source>
            <translation>Västeuropeisk</translation>
        </message>
        <message>
            <source>Western European, DOS</source>
            <translation>Västeuropeisk, DOS</translation>
        </message>
        <message>
            <source>Western European, Macintosh</source>
            <translation>Västeuropeisk, Macintosh</translation>
        </message>
        <message>
            <source>What</source>
            <translation>Vad</translation>
        </message>
        <message>
            <source>What cannot be read gets its default at the next start; the file is kept beside.</source>
            <translation>Det som inte kan läsas får sitt standardvärde vid nästa start; filen behålls bredvid.</translation>
        </message>
        <message>
            <source>What is not known of the foot changes it too much.</source>
            <translation>Det som inte är känt om foten ändrar det för mycket.</translation>
        </message>
        <message>
            <source>What it is prescribed as, a kind of the pad library; its shape if left out</source>
            <translation>Vad den ordineras som, en sort ur pelottbiblioteket; dess form om den utelämnas</translation>
        </message>
        <message>
            <source>What lies ahead of the metatarsal heads, in place of the scanned toes</source>
            <translation>Vad som ligger framför metatarsalhuvudena, i stället för de skannade tårna</translation>
        </message>
        <message>
            <source>What the edge of the insole follows</source>
            <translation>Vad inläggets kant följer</translation>
        </message>
        <message>
            <source>What the layer is made of; a material of the clinic's table</source>
            <translation>Vad lagret är gjort av; ett material ur klinikens tabell</translation>
        </message>
        <message>
            <source>What the pad looks like from above</source>
            <translation>Hur pelotten ser ut uppifrån</translation>
        </message>
        <message>
            <source>What the shell is made of; a material of the clinic's table</source>
            <translation>Vad skalet är gjort av; ett material ur klinikens tabell</translation>
        </message>
        <message>
            <source>What the stroke does to the surface</source>
            <translation>Vad draget gör med ytan</translation>
        </message>
        <message>
            <source>What was measured in the volume of interest does not look like a foot; see that a foot was in place, and that the volume holds nothing else.</source>
            <translation>Det som mättes i volymen av intresse liknar ingen fot; se till att en fot var på plats, och att volymen inte innehåller något annat.</translation>
        </message>
        <message>
            <source>Where each part lies</source>
            <translation>Var varje del ligger</translation>
        </message>
        <message>
            <source>Where the shell ends in front, from border to border</source>
            <translation>Var skalet slutar framtill, från kant till kant</translation>
        </message>
        <message>
            <source>Widen the pad</source>
            <translation>Bredda pelotten</translation>
        </message>
        <message>
            <source>Widening of heel and lateral border: soft tissue spreads in stance</source>
            <translation>Breddning av häl och lateral kant: mjukdelarna breder ut sig vid belastning</translation>
        </message>
        <message>
            <source>Width</source>
            <translation>Bredd</translation>
        </message>
        <message>
            <source>Width of the bevel along the upper edge</source>
            <translation>Fasens bredd längs den övre kanten</translation>
        </message>
        <message>
            <source>Width of the pad</source>
            <translation>Pelottens bredd</translation>
        </message>
        <message>
            <source>Width of the transition from support to rim at the forefoot</source>
            <translation>Bredden på övergången från stöd till kant vid framfoten</translation>
        </message>
        <message>
            <source>Width of the transition from support to rim at the heel</source>
            <translation>Bredden på övergången från stöd till kant vid hälen</translation>
        </message>
        <message>
            <source>Width of the transition from support to rim in the arch</source>
            <translation>Bredden på övergången från stöd till kant i hålfoten</translation>
        </message>
        <message>
            <source>Width of the zone that is raised</source>
            <translation>Bredd på området som höjs</translation>
        </message>
        <message>
            <source>Width over which folds of the skin are evened out; 0 for none</source>
            <translation>Bredd över vilken hudveck jämnas ut; 0 för ingen</translation>
        </message>
        <message>
            <source>Windows cannot load a library of {name}; run the installer of Insole Studio again, and install the updates of Windows.</source>
            <translation>Windows kan inte läsa in ett bibliotek till {name}; kör Insole Studios installationsprogram igen och installera uppdateringarna av Windows.</translation>
        </message>
        <message>
            <source>Worn heel pad</source>
            <translation>Tunn hälkudde</translation>
        </message>
        <message>
            <source>Writing the file</source>
            <translation>Skriver filen</translation>
        </message>
        <message>
            <source>Writing the identification</source>
            <translation>Skriver märkningen</translation>
        </message>
        <message>
            <source>Writing the insole</source>
            <translation>Inlägget skrivs</translation>
        </message>
        <message>
            <source>Writing the job sheet</source>
            <translation>Skriver arbetsordern</translation>
        </message>
        <message>
            <source>Writing the nest sheet</source>
            <translation>Skriver samläggningsbladet</translation>
        </message>
        <message>
            <source>Writing the order</source>
            <translation>Skriver beställningen</translation>
        </message>
        <message>
            <source>Writing the outlines</source>
            <translation>Skriver konturerna</translation>
        </message>
        <message>
            <source>Writing the prescription</source>
            <translation>Skriver ordinationen</translation>
        </message>
        <message>
            <source>Writing the program</source>
            <translation>Skriver programmet</translation>
        </message>
        <message>
            <source>Writing the set-up sheet</source>
            <translation>Skriver inställningsbladet</translation>
        </message>
        <message>
            <source>Writing the summary</source>
            <translation>Skriver sammanfattningen</translation>
        </message>
        <message>
            <source>Writing view {view}</source>
            <translation>Skriver vyn {view}</translation>
        </message>
        <message>
            <source>Written by</source>
            <translation>Skrivet av</translation>
        </message>
        <message>
            <source>X{x:.1f} Y{y:.1f}</source>
            <translation>X{x:.1f} Y{y:.1f}</translation>
        </message>
        <message>
            <source>You are not signed in; sign in with your account of the record first.</source>
            <translation>Du är inte inloggad; logga först in med ditt konto i journalen.</translation>
        </message>
        <message>
            <source>Zero</source>
            <translation>Nollpunkt</translation>
        </message>
        <message>
            <source>Zones of other density are for insoles only; choose the insole as the piece, or no printer.</source>
            <translation>Zoner med annan täthet finns bara för inlägg; välj inlägget som stycke, eller ingen skrivare.</translation>
        </message>
        <message>
            <source>a PDF</source>
            <translation>en PDF</translation>
        </message>
        <message>
            <source>a STEP model of a CAD program</source>
            <translation>en STEP-modell från ett CAD-program</translation>
        </message>
        <message>
            <source>a colour picture was taken {apart_ms:.0f} ms before or after the depth, so what moved meanwhile is in another place; capture it again if the foot was not quite still</source>
            <translation>en färgbild togs {apart_ms:.0f} ms före eller efter djupet, så det som rörde sig under tiden är på en annan plats; ta om den ifall foten inte var helt stilla</translation>
        </message>
        <message>
            <source>a device or a pipe of that name is there; choose another name</source>
            <translation>där finns en enhet eller ett rör med det namnet; välj ett annat namn</translation>
        </message>
        <message>
            <source>a face in it has fewer corners than it declares</source>
            <translation>en yta i den har färre hörn än den anger</translation>
        </message>
        <message>
            <source>a face in it is incomplete</source>
            <translation>en yta i den är ofullständig</translation>
        </message>
        <message>
            <source>a file is there where a folder is needed; choose another name</source>
            <translation>en fil ligger där en mapp behövs; välj ett annat namn</translation>
        </message>
        <message>
            <source>a folder of that name is there; choose another name</source>
            <translation>en mapp med det namnet finns där; välj ett annat namn</translation>
        </message>
        <message>
            <source>a foot of {length_mm:.0f} mm</source>
            <translation>en fot på {length_mm:.0f} mm</translation>
        </message>
        <message>
            <source>a foot of {length_mm:.0f} mm (a child's, EU {size:.0f})</source>
            <translation>en fot på {length_mm:.0f} mm (ett barns, EU {size:.0f})</translation>
        </message>
        <message>
            <source>a foot without toes, of which {scanned_mm:.0f} mm were scanned</source>
            <translation>en fot utan tår, av vilken {scanned_mm:.0f} mm skannades</translation>
        </message>
        <message>
            <source>a line of it is longer than a point with its colours; each point has its own line</source>
            <translation>en rad i den är längre än en punkt med sina färger; varje punkt ska ha en egen rad</translation>
        </message>
        <message>
            <source>a line of its {name} is incomplete</source>
            <translation>en rad av dess {name} är ofullständig</translation>
        </message>
        <message>
            <source>a model of Rhino</source>
            <translation>en modell från Rhino</translation>
        </message>
        <message>
            <source>a model of Rhino; export its mesh as .stl or .ply</source>
            <translation>en modell från Rhino; exportera dess mesh som .stl eller .ply</translation>
        </message>
        <message>
            <source>a model of a CAD program; export its mesh as .stl or .ply</source>
            <translation>en modell från ett CAD-program; exportera dess mesh som .stl eller .ply</translation>
        </message>
        <message>
            <source>a of the depth</source>
            <translation>djupets a</translation>
        </message>
        <message>
            <source>a packed archive; unpack it first</source>
            <translation>ett packat arkiv; packa upp det först</translation>
        </message>
        <message>
            <source>a picture</source>
            <translation>en bild</translation>
        </message>
        <message>
            <source>a point cloud of PCL (PCD)</source>
            <translation>ett punktmoln från PCL (PCD)</translation>
        </message>
        <message>
            <source>a point cloud of PCL; save it as .ply</source>
            <translation>ett punktmoln från PCL; spara det som .ply</translation>
        </message>
        <message>
            <source>a point cloud; save it as .ply</source>
            <translation>ett punktmoln; spara det som .ply</translation>
        </message>
        <message>
            <source>a point in it has fewer than three coordinates</source>
            <translation>en punkt i den har färre än tre koordinater</translation>
        </message>
        <message>
            <source>a polygon has more than {most} corners</source>
            <translation>en polygon har fler än {most} hörn</translation>
        </message>
        <message>
            <source>a scene of a graphics program; export the foot as .glb or .obj</source>
            <translation>en scen från ett grafikprogram; exportera foten som .glb eller .obj</translation>
        </message>
        <message>
            <source>a slice of a tomography; export the surface of the skin as .stl</source>
            <translation>ett snitt ur en tomografi; exportera hudens yta som .stl</translation>
        </message>
        <message>
            <source>a table or a text; points of a scan are read as .xyz, a pressure map by Tools</source>
            <translation>en tabell eller text; punkter i en skanning läses som .xyz, en tryckbild med Verktyg</translation>
        </message>
        <message>
            <source>a text in it holds half a character (\{half}); write it again.</source>
            <translation>en text i den innehåller ett halvt tecken (\{half}); skriv den på nytt.</translation>
        </message>
        <message>
            <source>a triangle in it does not have three corners of three numbers</source>
            <translation>en triangel i den har inte tre hörn med tre tal vart</translation>
        </message>
        <message>
            <source>a triangle in it is incomplete</source>
            <translation>en triangel i den är ofullständig</translation>
        </message>
        <message>
            <source>a triangle in it names a corner that it does not hold</source>
            <translation>en triangel i den nämner ett hörn som inte finns i den</translation>
        </message>
        <message>
            <source>a wall at {distance_mm:.0f} mm that fills {share:.0%}</source>
            <translation>en vägg på {distance_mm:.0f} mm som fyller {share:.0%}</translation>
        </message>
        <message>
            <source>a web page, as it is saved when a download fails</source>
            <translation>en webbsida, som den sparas när en hämtning misslyckas</translation>
        </message>
        <message>
            <source>a {side} one, {length}</source>
            <translation>{side}, {length}</translation>
        </message>
        <message>
            <source>absolute difference</source>
            <translation>skillnadens belopp</translation>
        </message>
        <message>
            <source>account</source>
            <translation>konto</translation>
        </message>
        <message>
            <source>achilles angle</source>
            <translation>akilles mot fotsula</translation>
        </message>
        <message>
            <source>achilles angle deg</source>
            <translation>akillesvinkel, °</translation>
        </message>
        <message>
            <source>achilles lean</source>
            <translation>akilles lutning</translation>
        </message>
        <message>
            <source>achilles lean deg</source>
            <translation>akillesaxelns lutning, °</translation>
        </message>
        <message>
            <source>add captures</source>
            <translation>lägga till inspelningar</translation>
        </message>
        <message>
            <source>added</source>
            <translation>tillagd</translation>
        </message>
        <message>
            <source>adjusted</source>
            <translation>justerad</translation>
        </message>
        <message>
            <source>administrator</source>
            <translation>administratör</translation>
        </message>
        <message>
            <source>adult flatfoot</source>
            <translation>förvärvad plattfot</translation>
        </message>
        <message>
            <source>along the axis of the foot</source>
            <translation>längs fotens axel</translation>
        </message>
        <message>
            <source>already there</source>
            <translation>finns redan</translation>
        </message>
        <message>
            <source>amputation</source>
            <translation>amputation</translation>
        </message>
        <message>
            <source>and height are {width}×{height}, but must be {allowed}</source>
            <translation>och höjd är {width}×{height}, men måste vara {allowed}</translation>
        </message>
        <message>
            <source>and height are {width}×{height}, more than the pictures of a sensor have</source>
            <translation>och höjden är {width}×{height}, mer än vad en sensors bilder har</translation>
        </message>
        <message>
            <source>angle of the sole sensors (degrees)</source>
            <translation>fotsulesensorernas vinkel (grader)</translation>
        </message>
        <message>
            <source>ankle</source>
            <translation>fotled</translation>
        </message>
        <message>
            <source>another list stands before the corners of its faces</source>
            <translation>en annan lista står före ytornas hörn</translation>
        </message>
        <message>
            <source>another program has it open; close it there, or choose another name</source>
            <translation>ett annat program har den öppen; stäng den där, eller välj ett annat namn</translation>
        </message>
        <message>
            <source>arch</source>
            <translation>valv</translation>
        </message>
        <message>
            <source>arch apex over the plane of heel, 1st and 5th head</source>
            <translation>valvets topp över planet genom häl, 1:a och 5:e huvudet</translation>
        </message>
        <message>
            <source>arch height</source>
            <translation>valvhöjd</translation>
        </message>
        <message>
            <source>arch height index</source>
            <translation>valvhöjdsindex</translation>
        </message>
        <message>
            <source>arch height of the simulated foot (mm)</source>
            <translation>den simulerade fotens valvhöjd (mm)</translation>
        </message>
        <message>
            <source>arch index</source>
            <translation>valvindex</translation>
        </message>
        <message>
            <source>arch pain</source>
            <translation>smärta i fotvalvet</translation>
        </message>
        <message>
            <source>arch raise</source>
            <translation>valvhöjning</translation>
        </message>
        <message>
            <source>arch support</source>
            <translation>valvstöd</translation>
        </message>
        <message>
            <source>arthrosis</source>
            <translation>artros</translation>
        </message>
        <message>
            <source>as EVA</source>
            <translation>som EVA</translation>
        </message>
        <message>
            <source>as both lie</source>
            <translation>som båda ligger</translation>
        </message>
        <message>
            <source>as scanned</source>
            <translation>som skannad</translation>
        </message>
        <message>
            <source>at the heel</source>
            <translation>vid hälen</translation>
        </message>
        <message>
            <source>at the toes</source>
            <translation>vid tårna</translation>
        </message>
        <message>
            <source>b of the depth</source>
            <translation>djupets b</translation>
        </message>
        <message>
            <source>back</source>
            <translation>bak</translation>
        </message>
        <message>
            <source>backed up</source>
            <translation>säkerhetskopierad</translation>
        </message>
        <message>
            <source>backup service</source>
            <translation>säkerhetskopiering</translation>
        </message>
        <message>
            <source>ball</source>
            <translation>trampdyna</translation>
        </message>
        <message>
            <source>ball girth</source>
            <translation>trampdynans omfång</translation>
        </message>
        <message>
            <source>ball length</source>
            <translation>längd till trampdynan</translation>
        </message>
        <message>
            <source>ball nose</source>
            <translation>kulfräs</translation>
        </message>
        <message>
            <source>ball width</source>
            <translation>trampdynans bredd</translation>
        </message>
        <message>
            <source>ball width across</source>
            <translation>trampdynans bredd tvärs</translation>
        </message>
        <message>
            <source>ball width of the simulated foot (mm)</source>
            <translation>den simulerade fotens bredd över trampdynan (mm)</translation>
        </message>
        <message>
            <source>bar</source>
            <translation>balk</translation>
        </message>
        <message>
            <source>base</source>
            <translation>bas</translation>
        </message>
        <message>
            <source>base form</source>
            <translation>basform</translation>
        </message>
        <message>
            <source>bends the edges of the picture more than a lens does</source>
            <translation>böjer bildens kanter mer än ett objektiv gör</translation>
        </message>
        <message>
            <source>big toe</source>
            <translation>stortå</translation>
        </message>
        <message>
            <source>birth date</source>
            <translation>födelsedatum</translation>
        </message>
        <message>
            <source>birth date unknown</source>
            <translation>födelsedatum okänt</translation>
        </message>
        <message>
            <source>bisection of the calcaneus against the Achilles axis; &gt; 0 is valgus</source>
            <translation>calcaneus mittlinje mot akillesaxeln; &gt; 0 är valgus</translation>
        </message>
        <message>
            <source>blank</source>
            <translation>ämne</translation>
        </message>
        <message>
            <source>block</source>
            <translation>block</translation>
        </message>
        <message>
            <source>border</source>
            <translation>kant</translation>
        </message>
        <message>
            <source>born {day}</source>
            <translation>född {day}</translation>
        </message>
        <message>
            <source>bottom</source>
            <translation>undersida</translation>
        </message>
        <message>
            <source>bruised heel</source>
            <translation>hälkontusion</translation>
        </message>
        <message>
            <source>brush stroke</source>
            <translation>penseldrag</translation>
        </message>
        <message>
            <source>bunionette</source>
            <translation>bunionett</translation>
        </message>
        <message>
            <source>by "depth_unit_mm" in its sensor.json what it sees is {near_mm:.0f} mm away, where no foot can be; put in the unit of its depth frames</source>
            <translation>enligt ”depth_unit_mm” i dess sensor.json är det som den ser {near_mm:.0f} mm bort, där ingen fot kan vara; ange enheten för dess djupbilder</translation>
        </message>
        <message>
            <source>bytes in it are cut off</source>
            <translation>byte i den är avklippta</translation>
        </message>
        <message>
            <source>calcaneal spur</source>
            <translation>kalkaneussporre</translation>
        </message>
        <message>
            <source>calcaneal valgus</source>
            <translation>hälvalgus</translation>
        </message>
        <message>
            <source>calcar</source>
            <translation>hälbenssporre</translation>
        </message>
        <message>
            <source>calf</source>
            <translation>vad</translation>
        </message>
        <message>
            <source>calibrated on</source>
            <translation>kalibrerade</translation>
        </message>
        <message>
            <source>callus</source>
            <translation>förhårdnad</translation>
        </message>
        <message>
            <source>camera</source>
            <translation>färgkamera</translation>
        </message>
        <message>
            <source>cancelled</source>
            <translation>makulerad</translation>
        </message>
        <message>
            <source>cannot be examined</source>
            <translation>kan inte undersökas</translation>
        </message>
        <message>
            <source>cannot be opened</source>
            <translation>kan inte öppnas</translation>
        </message>
        <message>
            <source>caption of the photo</source>
            <translation>fotots bildtext</translation>
        </message>
        <message>
            <source>capture</source>
            <translation>avbildning</translation>
        </message>
        <message>
            <source>captured</source>
            <translation>avbildad</translation>
        </message>
        <message>
            <source>cast</source>
            <translation>gips</translation>
        </message>
        <message>
            <source>centimetres</source>
            <translation>centimeter</translation>
        </message>
        <message>
            <source>centre</source>
            <translation>mitt</translation>
        </message>
        <message>
            <source>change of pressure</source>
            <translation>tryckets förändring</translation>
        </message>
        <message>
            <source>change patients, visits and prescriptions</source>
            <translation>ändra patienter, besök och ordinationer</translation>
        </message>
        <message>
            <source>change the settings of the clinic</source>
            <translation>ändra klinikens inställningar</translation>
        </message>
        <message>
            <source>changed</source>
            <translation>ändrad</translation>
        </message>
        <message>
            <source>changed password</source>
            <translation>bytte lösenord</translation>
        </message>
        <message>
            <source>checked</source>
            <translation>kontrollerad</translation>
        </message>
        <message>
            <source>child</source>
            <translation>barn</translation>
        </message>
        <message>
            <source>claborthotics-maker/orthoscan, lib/models</source>
            <translation>claborthotics-maker/orthoscan, lib/models</translation>
        </message>
        <message>
            <source>claw toes</source>
            <translation>klotår</translation>
        </message>
        <message>
            <source>clearing</source>
            <translation>grovfräsning</translation>
        </message>
        <message>
            <source>clinic</source>
            <translation>klinik</translation>
        </message>
        <message>
            <source>cobra</source>
            <translation>cobra</translation>
        </message>
        <message>
            <source>colour</source>
            <translation>färg</translation>
        </message>
        <message>
            <source>colour pictures and depth</source>
            <translation>färgbilder med djup</translation>
        </message>
        <message>
            <source>colour pictures of the board</source>
            <translation>färgbilder av brädet</translation>
        </message>
        <message>
            <source>compared area</source>
            <translation>jämförd yta</translation>
        </message>
        <message>
            <source>contact</source>
            <translation>kontakt</translation>
        </message>
        <message>
            <source>contents</source>
            <translation>filer</translation>
        </message>
        <message>
            <source>contour</source>
            <translation>kontur</translation>
        </message>
        <message>
            <source>coordinates in it are no numbers</source>
            <translation>koordinater i den är inga tal</translation>
        </message>
        <message>
            <source>corn</source>
            <translation>liktorn</translation>
        </message>
        <message>
            <source>corrections holds {count} of them, and may hold {most}; remove some.</source>
            <translation>corrections innehåller {count} stycken, och får innehålla {most}; ta bort några.</translation>
        </message>
        <message>
            <source>corrections must be a list; put the corrections in [ ].</source>
            <translation>corrections måste vara en lista; sätt korrigeringarna i [ ].</translation>
        </message>
        <message>
            <source>corrects disparities, but there is no "stereo" with the baseline that makes them; add it, or take out the correction</source>
            <translation>rättar dispariteter, men det finns ingen ”stereo” med den bas som ger dem; lägg till den, eller ta bort rättningen</translation>
        </message>
        <message>
            <source>cover</source>
            <translation>överdrag</translation>
        </message>
        <message>
            <source>cuboid</source>
            <translation>kuboid</translation>
        </message>
        <message>
            <source>cuboid raise</source>
            <translation>kuboidstöd</translation>
        </message>
        <message>
            <source>cupped</source>
            <translation>skålad</translation>
        </message>
        <message>
            <source>cut out</source>
            <translation>urtag</translation>
        </message>
        <message>
            <source>cut-out</source>
            <translation>urtag</translation>
        </message>
        <message>
            <source>cutter</source>
            <translation>fräs</translation>
        </message>
        <message>
            <source>cx of the colour camera</source>
            <translation>färgkamerans cx</translation>
        </message>
        <message>
            <source>cx of the depth camera</source>
            <translation>djupkamerans cx</translation>
        </message>
        <message>
            <source>cy of the colour camera</source>
            <translation>färgkamerans cy</translation>
        </message>
        <message>
            <source>cy of the depth camera</source>
            <translation>djupkamerans cy</translation>
        </message>
        <message>
            <source>damaged in part</source>
            <translation>delvis skadade</translation>
        </message>
        <message>
            <source>dancer's pad</source>
            <translation>dansarpelott</translation>
        </message>
        <message>
            <source>dark</source>
            <translation>mörk</translation>
        </message>
        <message>
            <source>date</source>
            <translation>datum</translation>
        </message>
        <message>
            <source>date of consent</source>
            <translation>samtyckesdatum</translation>
        </message>
        <message>
            <source>date of the follow-up</source>
            <translation>uppföljningens datum</translation>
        </message>
        <message>
            <source>date of the visit</source>
            <translation>Besöksdatumet</translation>
        </message>
        <message>
            <source>date that it is due</source>
            <translation>leveransdatum</translation>
        </message>
        <message>
            <source>day of the visit</source>
            <translation>besöksdag</translation>
        </message>
        <message>
            <source>default</source>
            <translation>förval</translation>
        </message>
        <message>
            <source>degrees</source>
            <translation>grader</translation>
        </message>
        <message>
            <source>degrees uncertain in direction</source>
            <translation>grader osäkert i riktning</translation>
        </message>
        <message>
            <source>deleted</source>
            <translation>borttaget</translation>
        </message>
        <message>
            <source>delivered</source>
            <translation>levererad</translation>
        </message>
        <message>
            <source>depth</source>
            <translation>djup</translation>
        </message>
        <message>
            <source>depth camera</source>
            <translation>djupkamera</translation>
        </message>
        <message>
            <source>designed</source>
            <translation>utformad</translation>
        </message>
        <message>
            <source>designed by</source>
            <translation>utformad av</translation>
        </message>
        <message>
            <source>device</source>
            <translation>inläggstyp</translation>
        </message>
        <message>
            <source>diabetes</source>
            <translation>diabetes</translation>
        </message>
        <message>
            <source>diameter {diameter} mm, at {places}</source>
            <translation>diameter {diameter} mm, vid {places}</translation>
        </message>
        <message>
            <source>disparity</source>
            <translation>disparitet</translation>
        </message>
        <message>
            <source>distance of the sensors</source>
            <translation>sensorernas avstånd</translation>
        </message>
        <message>
            <source>distance of the sensors (mm)</source>
            <translation>sensorernas avstånd (mm)</translation>
        </message>
        <message>
            <source>distortion</source>
            <translation>distorsion</translation>
        </message>
        <message>
            <source>disturbs others with its light; take its view alone</source>
            <translation>stör andra med sitt ljus; ta dess vy ensam</translation>
        </message>
        <message>
            <source>does not belong here: a device fits both feet; leave it out</source>
            <translation>hör inte hit: en inläggstyp passar båda fötterna; utelämna det</translation>
        </message>
        <message>
            <source>does not tell when its pictures were taken; use another one</source>
            <translation>säger inte när dess bilder togs; använd en annan</translation>
        </message>
        <message>
            <source>doubtful</source>
            <translation>tveksamma</translation>
        </message>
        <message>
            <source>downwards</source>
            <translation>nedåt</translation>
        </message>
        <message>
            <source>draft of the walls</source>
            <translation>väggarnas släppning</translation>
        </message>
        <message>
            <source>drawn</source>
            <translation>ritad</translation>
        </message>
        <message>
            <source>drop</source>
            <translation>droppe</translation>
        </message>
        <message>
            <source>due {day}</source>
            <translation>klar {day}</translation>
        </message>
        <message>
            <source>edge {value}</source>
            <translation>kant {value}</translation>
        </message>
        <message>
            <source>egg</source>
            <translation>ägg</translation>
        </message>
        <message>
            <source>equinus</source>
            <translation>spetsfot</translation>
        </message>
        <message>
            <source>erase patients</source>
            <translation>radera patienter</translation>
        </message>
        <message>
            <source>erased</source>
            <translation>raderad</translation>
        </message>
        <message>
            <source>error</source>
            <translation>fel</translation>
        </message>
        <message>
            <source>export patients</source>
            <translation>exportera patienter</translation>
        </message>
        <message>
            <source>exported</source>
            <translation>exporterad</translation>
        </message>
        <message>
            <source>extra wide</source>
            <translation>extra bred</translation>
        </message>
        <message>
            <source>extrinsic</source>
            <translation>extern</translation>
        </message>
        <message>
            <source>fallen arch</source>
            <translation>nedsjunket fotvalv</translation>
        </message>
        <message>
            <source>family name</source>
            <translation>efternamn</translation>
        </message>
        <message>
            <source>fascia</source>
            <translation>fascia</translation>
        </message>
        <message>
            <source>fat pad</source>
            <translation>fettkudde</translation>
        </message>
        <message>
            <source>fifth ray</source>
            <translation>femte strålen</translation>
        </message>
        <message>
            <source>fifth-ray cut-out</source>
            <translation>urtag för femte strålen</translation>
        </message>
        <message>
            <source>file name</source>
            <translation>Filnamnet</translation>
        </message>
        <message>
            <source>filler</source>
            <translation>fyllnad</translation>
        </message>
        <message>
            <source>filler for the 1st toe</source>
            <translation>utfyllnad för första tån</translation>
        </message>
        <message>
            <source>filler for the 2nd toe</source>
            <translation>utfyllnad för andra tån</translation>
        </message>
        <message>
            <source>filler for the 3rd toe</source>
            <translation>utfyllnad för tredje tån</translation>
        </message>
        <message>
            <source>filler for the 4th toe</source>
            <translation>utfyllnad för fjärde tån</translation>
        </message>
        <message>
            <source>filler for the 5th toe</source>
            <translation>utfyllnad för femte tån</translation>
        </message>
        <message>
            <source>findings</source>
            <translation>fynd</translation>
        </message>
        <message>
            <source>finish</source>
            <translation>utformning av kanten</translation>
        </message>
        <message>
            <source>finishing</source>
            <translation>finfräsning</translation>
        </message>
        <message>
            <source>first</source>
            <translation>första</translation>
        </message>
        <message>
            <source>first head</source>
            <translation>första metatarsalhuvudet</translation>
        </message>
        <message>
            <source>first minus second</source>
            <translation>första minus andra</translation>
        </message>
        <message>
            <source>first ray</source>
            <translation>första strålen</translation>
        </message>
        <message>
            <source>first step pain</source>
            <translation>smärta vid första stegen</translation>
        </message>
        <message>
            <source>first-ray cut-out</source>
            <translation>urtag för första strålen</translation>
        </message>
        <message>
            <source>flat</source>
            <translation>plan</translation>
        </message>
        <message>
            <source>flat outline</source>
            <translation>plan kontur</translation>
        </message>
        <message>
            <source>flat pad</source>
            <translation>plan pelott</translation>
        </message>
        <message>
            <source>flatfoot</source>
            <translation>plattfot</translation>
        </message>
        <message>
            <source>folder of the order</source>
            <translation>beställningens mapp</translation>
        </message>
        <message>
            <source>follow up</source>
            <translation>uppföljning</translation>
        </message>
        <message>
            <source>following</source>
            <translation>följsam</translation>
        </message>
        <message>
            <source>foot</source>
            <translation>fot</translation>
        </message>
        <message>
            <source>foot length</source>
            <translation>fotlängd</translation>
        </message>
        <message>
            <source>foot length, rounded up to 5 mm</source>
            <translation>fotlängden, avrundad uppåt till 5 mm</translation>
        </message>
        <message>
            <source>foot side</source>
            <translation>fotsidan</translation>
        </message>
        <message>
            <source>forefoot</source>
            <translation>framfot</translation>
        </message>
        <message>
            <source>forefoot angle</source>
            <translation>framfotsvinkel</translation>
        </message>
        <message>
            <source>forefoot angle deg</source>
            <translation>framfotsvinkel, °</translation>
        </message>
        <message>
            <source>forefoot filler</source>
            <translation>framfotsutfyllnad</translation>
        </message>
        <message>
            <source>forefoot pain</source>
            <translation>framfotssmärta</translation>
        </message>
        <message>
            <source>forefoot post</source>
            <translation>framfotskil</translation>
        </message>
        <message>
            <source>forefoot twist</source>
            <translation>framfotsvridning</translation>
        </message>
        <message>
            <source>forefoot valgus</source>
            <translation>framfotsvalgus</translation>
        </message>
        <message>
            <source>forefoot varus</source>
            <translation>framfotsvarus</translation>
        </message>
        <message>
            <source>forefoot width</source>
            <translation>framfotsbredd</translation>
        </message>
        <message>
            <source>format must be "{format}"; this is no design of an insole.</source>
            <translation>format måste vara ”{format}”; detta är ingen design av ett inlägg.</translation>
        </message>
        <message>
            <source>free-hand pad</source>
            <translation>frihandspelott</translation>
        </message>
        <message>
            <source>from above</source>
            <translation>ovanifrån</translation>
        </message>
        <message>
            <source>from below</source>
            <translation>underifrån</translation>
        </message>
        <message>
            <source>from the foot</source>
            <translation>från foten</translation>
        </message>
        <message>
            <source>from the scan {name}</source>
            <translation>från skanningen {name}</translation>
        </message>
        <message>
            <source>from the shoe size</source>
            <translation>från skostorleken</translation>
        </message>
        <message>
            <source>from {low:g} kPa</source>
            <translation>från {low:g} kPa</translation>
        </message>
        <message>
            <source>front</source>
            <translation>fram</translation>
        </message>
        <message>
            <source>front edge</source>
            <translation>framkant</translation>
        </message>
        <message>
            <source>full</source>
            <translation>hel</translation>
        </message>
        <message>
            <source>full length</source>
            <translation>hel längd</translation>
        </message>
        <message>
            <source>full weight-bearing</source>
            <translation>belastad</translation>
        </message>
        <message>
            <source>full-length lift</source>
            <translation>hel höjning</translation>
        </message>
        <message>
            <source>given name</source>
            <translation>förnamn</translation>
        </message>
        <message>
            <source>gives a length that no shoe has; check step and least size</source>
            <translation>ger en längd som ingen sko har; kontrollera steg och minsta storlek</translation>
        </message>
        <message>
            <source>glued on later</source>
            <translation>limmas på senare</translation>
        </message>
        <message>
            <source>granted to whoever sits at this computer</source>
            <translation>ges till den som sitter vid datorn</translation>
        </message>
        <message>
            <source>greatest width of the heel at 10 to 22 % of the length</source>
            <translation>hälens största bredd vid 10 till 22 % av längden</translation>
        </message>
        <message>
            <source>hammer toe</source>
            <translation>hammartå</translation>
        </message>
        <message>
            <source>has a lateral border on the medial side; change the two</source>
            <translation>har en lateral kant på den mediala sidan; byt de två</translation>
        </message>
        <message>
            <source>has a projector of one power only; leave the power as it is</source>
            <translation>har en projektor med bara en effekt; låt effekten vara</translation>
        </message>
        <message>
            <source>has a volume that reaches into that of the right foot; make the volumes narrower</source>
            <translation>har en volym som når in i högerfotens; gör volymerna smalare</translation>
        </message>
        <message>
            <source>has more than {most} corners</source>
            <translation>har fler än {most} hörn</translation>
        </message>
        <message>
            <source>has no light that blinks; cover it to see which one it is</source>
            <translation>har ingen lampa som blinkar; täck den för att se vilken det är</translation>
        </message>
        <message>
            <source>has no motor; turn it by hand</source>
            <translation>har ingen motor; vrid den för hand</translation>
        </message>
        <message>
            <source>has no pair of infrared pictures; leave them out</source>
            <translation>har inget par av infraröda bilder; utelämna dem</translation>
        </message>
        <message>
            <source>has not the same number of sensors in each row</source>
            <translation>har inte lika många sensorer i varje rad</translation>
        </message>
        <message>
            <source>has the word "{word}", which changes the units or the way of counting; correct the line "{line}"</source>
            <translation>har ordet ”{word}”, som ändrar enheter eller sättet att räkna; rätta raden ”{line}”</translation>
        </message>
        <message>
            <source>has the word "{word}", which no controller knows; correct the line "{line}"</source>
            <translation>har ordet ”{word}”, som ingen styrning känner till; rätta raden ”{line}”</translation>
        </message>
        <message>
            <source>has two cutters of one number; number them differently</source>
            <translation>har två fräsar med samma nummer; ge dem olika nummer</translation>
        </message>
        <message>
            <source>has two feet of the same side</source>
            <translation>har två fötter av samma sida</translation>
        </message>
        <message>
            <source>has {count} letters, but may have {most}</source>
            <translation>har {count} bokstäver, men får ha {most}</translation>
        </message>
        <message>
            <source>has {count} markers, but a reference system has at most {most}</source>
            <translation>har {count} markörer, men ett referenssystem har högst {most}</translation>
        </message>
        <message>
            <source>has {count} markers, but at least 4 are needed</source>
            <translation>har {count} markörer, men minst 4 behövs</translation>
        </message>
        <message>
            <source>has {count} zones, and a print may have {most}; put some of them together</source>
            <translation>har {count} zoner, och en utskrift får ha {most}; slå ihop några av dem</translation>
        </message>
        <message>
            <source>has {found} numbers, but must have {count}</source>
            <translation>har {found} tal, men måste ha {count}</translation>
        </message>
        <message>
            <source>have the same name twice</source>
            <translation>har samma namn två gånger</translation>
        </message>
        <message>
            <source>heads</source>
            <translation>metatarsalhuvuden</translation>
        </message>
        <message>
            <source>heel</source>
            <translation>häl</translation>
        </message>
        <message>
            <source>heel centre</source>
            <translation>hälcentrum</translation>
        </message>
        <message>
            <source>heel cup</source>
            <translation>hälskål</translation>
        </message>
        <message>
            <source>heel lift</source>
            <translation>hälhöjning</translation>
        </message>
        <message>
            <source>heel pain</source>
            <translation>hälsmärta</translation>
        </message>
        <message>
            <source>heel skive</source>
            <translation>hälskivning</translation>
        </message>
        <message>
            <source>heel ulcer</source>
            <translation>hälsår</translation>
        </message>
        <message>
            <source>heel width</source>
            <translation>hälbredd</translation>
        </message>
        <message>
            <source>heel width of the simulated foot (mm)</source>
            <translation>den simulerade fotens hälbredd (mm)</translation>
        </message>
        <message>
            <source>heel-spur recess</source>
            <translation>hälsporreurtag</translation>
        </message>
        <message>
            <source>height</source>
            <translation>höjd</translation>
        </message>
        <message>
            <source>heights_mm of form must have {rows} rows of {columns} heights, one for each station.</source>
            <translation>heights_mm i form måste ha {rows} rader med {columns} höjder, en för varje station.</translation>
        </message>
        <message>
            <source>high arch</source>
            <translation>högt fotvalv</translation>
        </message>
        <message>
            <source>high cup</source>
            <translation>hög hälskål</translation>
        </message>
        <message>
            <source>highest dorsal point at half of the foot length</source>
            <translation>högsta dorsala punkten vid halva fotlängden</translation>
        </message>
        <message>
            <source>hindfoot</source>
            <translation>bakfot</translation>
        </message>
        <message>
            <source>holds no material; add one</source>
            <translation>innehåller inget material; lägg till ett</translation>
        </message>
        <message>
            <source>holds no preset; add one</source>
            <translation>har ingen förinställning; lägg till en</translation>
        </message>
        <message>
            <source>holds no pressure</source>
            <translation>innehåller inget tryck</translation>
        </message>
        <message>
            <source>holds the weight of a body or the points of a trim line, which belong to one foot; leave them out</source>
            <translation>innehåller en kroppsvikt eller punkterna på en klipplinje, som hör till en enda fot; utelämna dem</translation>
        </message>
        <message>
            <source>holes for the dowels</source>
            <translation>hål för styrpinnarna</translation>
        </message>
        <message>
            <source>horseshoe</source>
            <translation>hästsko</translation>
        </message>
        <message>
            <source>imprint</source>
            <translation>avtryck</translation>
        </message>
        <message>
            <source>in production</source>
            <translation>i produktion</translation>
        </message>
        <message>
            <source>inches</source>
            <translation>tum</translation>
        </message>
        <message>
            <source>infrared</source>
            <translation>infrarött</translation>
        </message>
        <message>
            <source>infrared and colour pictures</source>
            <translation>infraröda bilder och färgbilder</translation>
        </message>
        <message>
            <source>infrared pictures of the board, taken with the emitter covered</source>
            <translation>infraröda bilder av brädet, tagna med täckt projektor</translation>
        </message>
        <message>
            <source>insole</source>
            <translation>inlägget</translation>
        </message>
        <message>
            <source>instep height</source>
            <translation>vristhöjd</translation>
        </message>
        <message>
            <source>instep height / length from heel to 1st head</source>
            <translation>vristhöjd / längd från häl till 1:a huvudet</translation>
        </message>
        <message>
            <source>intrinsic</source>
            <translation>intern</translation>
        </message>
        <message>
            <source>is "both", but the reference system "{system}" is for one foot; name the foot that was captured, or the system for two feet that was used</source>
            <translation>är "both", men referenssystemet ”{system}” är för en fot; ange vilken fot som avbildades, eller det system för två fötter som användes</translation>
        </message>
        <message>
            <source>is "{name}", but must be the plain name of a file, without folders</source>
            <translation>är ”{name}” men måste vara ett filnamn utan mappar</translation>
        </message>
        <message>
            <source>is "{side}", but the reference system "{system}" is for both feet; make it "both", or name the system for one foot that was used</source>
            <translation>är ”{side}”, men referenssystemet ”{system}” är för båda fötterna; sätt det till ”both”, eller ange systemet för en fot som användes</translation>
        </message>
        <message>
            <source>is "{text}", but must be a date such as 2026-11-20T10:00:00Z</source>
            <translation>är ”{text}”, men måste vara ett datum som 2026-11-20T10:00:00Z</translation>
        </message>
        <message>
            <source>is 0, so that the cutter would stand still; put in the real value</source>
            <translation>är 0, så att fräsen skulle stå stilla; ange det verkliga värdet</translation>
        </message>
        <message>
            <source>is 1, that of a session of one foot, but "side" is "both"; make the version 2 if both feet were captured, or name the one that was</source>
            <translation>är 1, som för en session av en fot, men ”side” är ”both”; ändra versionen till 2 om båda fötterna avbildades, eller ange den som avbildades</translation>
        </message>
        <message>
            <source>is 1, that of a session of one foot, but the reference system "{system}" is for both feet; make it 2, and "side" "both"</source>
            <translation>är 1, som för en session med en fot, men referenssystemet ”{system}” är för båda fötterna; ändra till 2, och "side" till "both"</translation>
        </message>
        <message>
            <source>is 2, that of a session of both feet, but "side" is "{side}"; make the version 1 if this foot alone was captured</source>
            <translation>är 2, som för en session av båda fötterna, men ”side” är ”{side}”; ändra versionen till 1 om enbart denna fot avbildades</translation>
        </message>
        <message>
            <source>is empty, but a reference system has at least 4 markers</source>
            <translation>är tomt, men ett referenssystem har minst 4 markörer</translation>
        </message>
        <message>
            <source>is empty; mark the points in the image</source>
            <translation>är tom; märk punkterna i bilden</translation>
        </message>
        <message>
            <source>is for a session of one foot; of both, each has its own in "reference_frame.feet"</source>
            <translation>är för en session med en fot; med båda har var och en sin egen i "reference_frame.feet"</translation>
        </message>
        <message>
            <source>is missing</source>
            <translation>saknas</translation>
        </message>
        <message>
            <source>is no check; those are {check_names}</source>
            <translation>är ingen kontroll; kontrollerna är {check_names}</translation>
        </message>
        <message>
            <source>is no distance of sensors</source>
            <translation>är inget avstånd mellan sensorer</translation>
        </message>
        <message>
            <source>is no key of a device; check its spelling or leave it out ({known} are known)</source>
            <translation>är ingen nyckel för ett inlägg; kontrollera stavningen eller utelämna den ({known} är kända)</translation>
        </message>
        <message>
            <source>is no key of a finding; check its spelling or leave it out</source>
            <translation>är ingen nyckel för ett fynd; kontrollera stavningen eller utelämna den</translation>
        </message>
        <message>
            <source>is no key of a table of materials; check its spelling or leave it out</source>
            <translation>är ingen nyckel i en materialtabell; kontrollera stavningen eller utelämna den</translation>
        </message>
        <message>
            <source>is no key of findings; check its spelling or leave it out</source>
            <translation>är ingen nyckel i en fil med fynd; kontrollera stavningen eller utelämna den</translation>
        </message>
        <message>
            <source>is no key that is known here; check its spelling or leave it out</source>
            <translation>är ingen känd nyckel här; kontrollera stavningen eller utelämna den</translation>
        </message>
        <message>
            <source>is no picture</source>
            <translation>är ingen bild</translation>
        </message>
        <message>
            <source>is no rigid transform</source>
            <translation>är ingen stel transformation</translation>
        </message>
        <message>
            <source>is no view of this session</source>
            <translation>är ingen vy i denna session</translation>
        </message>
        <message>
            <source>is of a sensor that delivers millimetres, and "disparity" of one that delivers raw numbers; take out the one that is wrong</source>
            <translation>hör till en sensor som ger millimeter, och ”disparity” till en som ger råtal; ta bort den som är fel</translation>
        </message>
        <message>
            <source>is of a sensor that delivers millimetres, but "version" in manifest.json is that of a session of Kinects alone; make the version 3</source>
            <translation>hör till en sensor som ger millimeter, men ”version” i manifest.json är den för en session med enbart Kinect; sätt versionen till 3</translation>
        </message>
        <message>
            <source>is {number}, a {is_shape} one, and must be a {shape} one; choose another</source>
            <translation>är {number}, av formen {is_shape}, och måste vara av formen {shape}; välj en annan</translation>
        </message>
        <message>
            <source>is {number}, and no cutter has that number; add it</source>
            <translation>är {number}, och ingen fräs har det numret; lägg till den</translation>
        </message>
        <message>
            <source>is {value!r}, but must be "{wanted}"</source>
            <translation>är {value!r}, men måste vara ”{wanted}”</translation>
        </message>
        <message>
            <source>is {value}, but must be a finite number</source>
            <translation>är {value}, men måste vara ett ändligt tal</translation>
        </message>
        <message>
            <source>is {value}, but must be a number</source>
            <translation>är {value}, men måste vara ett tal</translation>
        </message>
        <message>
            <source>is {value}, but must be a whole number</source>
            <translation>är {value}, men måste vara ett heltal</translation>
        </message>
        <message>
            <source>is {value}, but must be true or false</source>
            <translation>är {value}, men måste vara true eller false</translation>
        </message>
        <message>
            <source>is {value}, but must be {allowed}</source>
            <translation>är {value}, men måste vara {allowed}</translation>
        </message>
        <message>
            <source>is {value}, but must lie between {least:g} and {most:g}</source>
            <translation>är {value}, men måste ligga mellan {least:g} och {most:g}</translation>
        </message>
        <message>
            <source>is {what}; its rows must be right-handed unit vectors</source>
            <translation>är {what}; raderna måste vara högerorienterade enhetsvektorer</translation>
        </message>
        <message>
            <source>it declares {count} bytes and holds {held}</source>
            <translation>den anger {count} byte och innehåller {held}</translation>
        </message>
        <message>
            <source>it declares {count} points and holds {held}</source>
            <translation>den anger {count} punkter och innehåller {held}</translation>
        </message>
        <message>
            <source>it declares {points} points and {faces} faces and holds {held} of both</source>
            <translation>den anger {points} punkter och {faces} ytor och innehåller sammanlagt {held}</translation>
        </message>
        <message>
            <source>it does not begin with "OFF" and the numbers of points and faces</source>
            <translation>den börjar inte med ”OFF” och antalet punkter och ytor</translation>
        </message>
        <message>
            <source>it has far more corners than a scan</source>
            <translation>den har långt fler hörn än en skanning</translation>
        </message>
        <message>
            <source>it has far more parts than a scan</source>
            <translation>den har långt fler delar än en skanning</translation>
        </message>
        <message>
            <source>it hides a zip archive</source>
            <translation>den döljer ett zip-arkiv</translation>
        </message>
        <message>
            <source>it holds a word where a number must stand</source>
            <translation>den har ett ord där ett tal måste stå</translation>
        </message>
        <message>
            <source>it holds arrays in parts, which are not read</source>
            <translation>den innehåller uppdelade talföljder, som inte läses</translation>
        </message>
        <message>
            <source>it holds fewer bytes than it declares</source>
            <translation>den innehåller färre byte än den anger</translation>
        </message>
        <message>
            <source>it holds no description of its meshes</source>
            <translation>den innehåller ingen beskrivning av sina ytor</translation>
        </message>
        <message>
            <source>it holds no mesh</source>
            <translation>den innehåller ingen yta</translation>
        </message>
        <message>
            <source>it holds no model</source>
            <translation>den innehåller ingen modell</translation>
        </message>
        <message>
            <source>it holds no model, or several</source>
            <translation>den innehåller ingen modell, eller flera</translation>
        </message>
        <message>
            <source>it holds no object</source>
            <translation>den innehåller inget föremål</translation>
        </message>
        <message>
            <source>it holds no object that is to be built</source>
            <translation>den innehåller inget föremål som ska byggas</translation>
        </message>
        <message>
            <source>it holds no points</source>
            <translation>den innehåller inga punkter</translation>
        </message>
        <message>
            <source>it holds no points with x, y and z</source>
            <translation>den innehåller inga punkter med x, y och z</translation>
        </message>
        <message>
            <source>it holds no scene</source>
            <translation>den innehåller ingen scen</translation>
        </message>
        <message>
            <source>it holds zero bytes, which no text does</source>
            <translation>den innehåller nollbyte, vilket ingen text gör</translation>
        </message>
        <message>
            <source>it is a pipe or a device, no file</source>
            <translation>det är ett rör eller en enhet, ingen fil</translation>
        </message>
        <message>
            <source>it is a rod, as a leg of a table</source>
            <translation>den är en stång, som ett bordsben</translation>
        </message>
        <message>
            <source>it is far from the foot</source>
            <translation>den ligger långt från foten</translation>
        </message>
        <message>
            <source>it is far larger than such a file is</source>
            <translation>den är mycket större än en sådan fil är</translation>
        </message>
        <message>
            <source>it is flat, as a sheet, a card or a wall</source>
            <translation>den är plan, som en skiva, ett kort eller en vägg</translation>
        </message>
        <message>
            <source>it is longer than {limit_mb} MB; check what was put there.</source>
            <translation>den är längre än {limit_mb} MB; kontrollera vad som lagts dit.</translation>
        </message>
        <message>
            <source>it is not flat, or something stood before it.</source>
            <translation>den är inte plan, eller något stod framför den.</translation>
        </message>
        <message>
            <source>it is of version {version} instead of 2</source>
            <translation>den är av version {version} i stället för 2</translation>
        </message>
        <message>
            <source>it is only looked at.</source>
            <translation>den betraktas bara.</translation>
        </message>
        <message>
            <source>it is shorter than its header</source>
            <translation>den är kortare än sitt huvud</translation>
        </message>
        <message>
            <source>it lacks {name}</source>
            <translation>den saknar {name}</translation>
        </message>
        <message>
            <source>it lies within the surface, as the inner side of a shell</source>
            <translation>den ligger innanför ytan, som insidan av ett skal</translation>
        </message>
        <message>
            <source>it measured no surface in the volume of interest; check that the foot was in place and "volume_of_interest_mm" in manifest.json</source>
            <translation>den mätte ingen yta i volymen av intresse; kontrollera att foten var på plats och ”volume_of_interest_mm” i manifest.json</translation>
        </message>
        <message>
            <source>it names something that it does not hold</source>
            <translation>den nämner något som inte finns i den</translation>
        </message>
        <message>
            <source>it or its folder is protected against changes; choose another name or place</source>
            <translation>den eller dess mapp är skyddad mot ändringar; välj ett annat namn eller en annan plats</translation>
        </message>
        <message>
            <source>it shows another pattern than the other walls.</source>
            <translation>den visar ett annat mönster än de andra väggarna.</translation>
        </message>
        <message>
            <source>it shows no flat wall that fills at least {share:.0%} of the view; point the sensor at an empty flat wall and capture it again.</source>
            <translation>den visar ingen plan vägg som fyller minst {share:.0%} av synfältet; rikta sensorn mot en tom plan vägg och ta om den.</translation>
        </message>
        <message>
            <source>it shows no plane, as {share:.0%} of it is off by more than {raw:.0f} raw units; capture a flat, empty wall.</source>
            <translation>den visar inget plan, då {share:.0%} av den avviker mer än {raw:.0f} råenheter; ta upp en plan, tom vägg.</translation>
        </message>
        <message>
            <source>it was switched off by hand</source>
            <translation>den stängdes av för hand</translation>
        </message>
        <message>
            <source>its colour picture is almost dark; give more light or a longer exposure</source>
            <translation>dess färgbild är nästan mörk; ge mer ljus eller längre exponering</translation>
        </message>
        <message>
            <source>its colour picture is out of focus; clean the lens and see that the camera is still</source>
            <translation>dess färgbild är oskarp; rengör linsen och se till att kameran är stilla</translation>
        </message>
        <message>
            <source>its colour picture is overexposed; take away light or shorten the exposure</source>
            <translation>dess färgbild är överexponerad; ta bort ljus eller korta exponeringen</translation>
        </message>
        <message>
            <source>its commas may be decimals or stand between the numbers</source>
            <translation>dess kommatecken kan vara decimaltecken eller stå mellan talen</translation>
        </message>
        <message>
            <source>its depth frames hold no reading; check the sensor's distance and that no sunlight falls on the foot</source>
            <translation>dess djupbilder saknar mätvärden; kontrollera sensorns avstånd och att inget solljus faller på foten</translation>
        </message>
        <message>
            <source>its depth is {percent:.0f} % {direction} than its markers in the colour image say; calibrate the sensor, and see that the session has the right reference system</source>
            <translation>dess djup är {percent:.0f} % {direction} än markörerna i färgbilden säger; kalibrera sensorn, och se till att sessionen har rätt referenssystem</translation>
        </message>
        <message>
            <source>its description is far too long</source>
            <translation>dess beskrivning är alldeles för lång</translation>
        </message>
        <message>
            <source>its description is no JSON object</source>
            <translation>dess beskrivning är inget JSON-objekt</translation>
        </message>
        <message>
            <source>its error of {error_px:.2f} px is far above that of the others</source>
            <translation>dess fel på {error_px:.2f} px är långt större än de andras</translation>
        </message>
        <message>
            <source>its faces name no corners</source>
            <translation>dess ytor nämner inga hörn</translation>
        </message>
        <message>
            <source>its folder does not exist; create the folder or choose another place</source>
            <translation>mappen finns inte; skapa mappen eller välj en annan plats</translation>
        </message>
        <message>
            <source>its format {name} is none of PLY</source>
            <translation>dess format {name} finns inte i PLY</translation>
        </message>
        <message>
            <source>its header holds "{text}"</source>
            <translation>dess huvud innehåller ”{text}”</translation>
        </message>
        <message>
            <source>its heel towards x = 0</source>
            <translation>hälen mot x = 0</translation>
        </message>
        <message>
            <source>its heel towards y = 0</source>
            <translation>hälen mot y = 0</translation>
        </message>
        <message>
            <source>its length of {length:g} mm along {along}, its width of {width:g} mm along {across}</source>
            <translation>längden {length:g} mm längs {along}, bredden {width:g} mm längs {across}</translation>
        </message>
        <message>
            <source>its lines do not hold the same number of columns, three or more</source>
            <translation>dess rader har inte samma antal kolumner, tre eller fler</translation>
        </message>
        <message>
            <source>its markers leave the pose {value:.2f} {what}, more than {limit:g} ({worst}); see that more markers are in view and that the reference system was not moved</source>
            <translation>dess markörer lämnar läget {value:.2f} {what}, mer än {limit:g} ({worst}); se till att fler markörer syns och att referenssystemet inte flyttats</translation>
        </message>
        <message>
            <source>its markers lie within {relief_mm:.1f} mm of one plane; raise some of them by a brick</source>
            <translation>dess markörer ligger inom {relief_mm:.1f} mm från ett plan; höj några av dem med en kloss</translation>
        </message>
        <message>
            <source>its markers lie {mean_mm:.1f} mm from the reference system on average, more than {limit_mm:g} mm (worst: {worst}); check that the reference system was not changed or moved</source>
            <translation>dess markörer ligger i medel {mean_mm:.1f} mm från referenssystemet, mer än {limit_mm:g} mm (sämst: {worst}); kontrollera att referenssystemet inte ändrats eller flyttats</translation>
        </message>
        <message>
            <source>its middle line along its length</source>
            <translation>mittlinjen längs dess längd</translation>
        </message>
        <message>
            <source>its middle line along its width</source>
            <translation>mittlinjen längs dess bredd</translation>
        </message>
        <message>
            <source>its nodes contain each other, or are far too many</source>
            <translation>dess noder innehåller varandra, eller är alldeles för många</translation>
        </message>
        <message>
            <source>its objects contain each other, or are far too many</source>
            <translation>dess föremål innehåller varandra, eller är alldeles för många</translation>
        </message>
        <message>
            <source>its parts do not fit together</source>
            <translation>dess delar passar inte ihop</translation>
        </message>
        <message>
            <source>its scene cannot be read</source>
            <translation>dess scen kan inte läsas</translation>
        </message>
        <message>
            <source>its sensor.json lists the faces {faces}, but the reference system "{system}" has the faces {system_faces}</source>
            <translation>dess sensor.json anger ytorna {faces}, men referenssystemet ”{system}” har ytorna {system_faces}</translation>
        </message>
        <message>
            <source>its sensor.json says that it sees the markers {faces}, but it sees "{face}"; exchange the views, or correct "faces" there</source>
            <translation>dess sensor.json säger att den ser markörerna {faces}, men den ser ”{face}”; byt vyerna, eller rätta ”faces” där</translation>
        </message>
        <message>
            <source>its toes towards x = 0</source>
            <translation>tårna mot x = 0</translation>
        </message>
        <message>
            <source>its unit is no length</source>
            <translation>dess enhet är ingen längd</translation>
        </message>
        <message>
            <source>its unit {unit} is none of 3MF</source>
            <translation>dess enhet {unit} finns inte i 3MF</translation>
        </message>
        <message>
            <source>its unit {unit} is none of AMF</source>
            <translation>dess enhet {unit} finns inte i AMF</translation>
        </message>
        <message>
            <source>judges its depth in one way only; leave out the preset</source>
            <translation>bedömer sitt djup på bara ett sätt; utelämna förvalet</translation>
        </message>
        <message>
            <source>kept</source>
            <translation>sparad</translation>
        </message>
        <message>
            <source>kind of number</source>
            <translation>slag av nummer</translation>
        </message>
        <message>
            <source>kind{where} has {count} letters, and must have 1 to {most}; shorten it, or leave it out.</source>
            <translation>kind{where} har {count} bokstäver och måste ha 1 till {most}; korta den, eller utelämna den.</translation>
        </message>
        <message>
            <source>known to about {deviation_mm:.1f} mm only</source>
            <translation>känt på bara omkring {deviation_mm:.1f} mm</translation>
        </message>
        <message>
            <source>laid on the first</source>
            <translation>lagd på den första</translation>
        </message>
        <message>
            <source>larger</source>
            <translation>större</translation>
        </message>
        <message>
            <source>largest</source>
            <translation>störst</translation>
        </message>
        <message>
            <source>last good backup {days:.1f} days old</source>
            <translation>senaste felfria säkerhetskopian är {days:.1f} dagar gammal</translation>
        </message>
        <message>
            <source>lateral</source>
            <translation>lateral</translation>
        </message>
        <message>
            <source>lateral midfoot pain</source>
            <translation>smärta på mellanfotens utsida</translation>
        </message>
        <message>
            <source>lateral rim</source>
            <translation>lateral kant</translation>
        </message>
        <message>
            <source>laterally</source>
            <translation>lateralt</translation>
        </message>
        <message>
            <source>layers</source>
            <translation>lager</translation>
        </message>
        <message>
            <source>least</source>
            <translation>minsta</translation>
        </message>
        <message>
            <source>least 3 under the heel usual; above 95 kg the clinic's own judgement</source>
            <translation>minst 3 under hälen är vanligt; över 95 kg klinikens egen bedömning</translation>
        </message>
        <message>
            <source>left</source>
            <translation>vänster</translation>
        </message>
        <message>
            <source>left and right</source>
            <translation>vänster och höger</translation>
        </message>
        <message>
            <source>left foot</source>
            <translation>vänster fot</translation>
        </message>
        <message>
            <source>left insole</source>
            <translation>vänster inlägg</translation>
        </message>
        <message>
            <source>left sole</source>
            <translation>vänster fotsula</translation>
        </message>
        <message>
            <source>leg length</source>
            <translation>benlängd</translation>
        </message>
        <message>
            <source>length</source>
            <translation>längd</translation>
        </message>
        <message>
            <source>length of the insole</source>
            <translation>inläggets längd</translation>
        </message>
        <message>
            <source>length of the simulated foot (mm)</source>
            <translation>den simulerade fotens längd (mm)</translation>
        </message>
        <message>
            <source>lift</source>
            <translation>höjning</translation>
        </message>
        <message>
            <source>line of the 1st to 5th head against the heel's ground; &gt; 0 is varus</source>
            <translation>linjen från 1:a till 5:e huvudet mot hälens underlag; &gt; 0 är varus</translation>
        </message>
        <message>
            <source>list the file {file} twice</source>
            <translation>anger filen {file} två gånger</translation>
        </message>
        <message>
            <source>locked</source>
            <translation>låst</translation>
        </message>
        <message>
            <source>lot of the material</source>
            <translation>materialets parti</translation>
        </message>
        <message>
            <source>low</source>
            <translation>låg</translation>
        </message>
        <message>
            <source>low arch</source>
            <translation>lågt fotvalv</translation>
        </message>
        <message>
            <source>lower</source>
            <translation>sänk</translation>
        </message>
        <message>
            <source>lower centre</source>
            <translation>nere i mitten</translation>
        </message>
        <message>
            <source>lower left</source>
            <translation>nere till vänster</translation>
        </message>
        <message>
            <source>lower right</source>
            <translation>nere till höger</translation>
        </message>
        <message>
            <source>made from</source>
            <translation>gjord av</translation>
        </message>
        <message>
            <source>made with Insole Studio {version}</source>
            <translation>gjord med Insole Studio {version}</translation>
        </message>
        <message>
            <source>made with it</source>
            <translation>tillverkas med</translation>
        </message>
        <message>
            <source>make backups</source>
            <translation>göra säkerhetskopior</translation>
        </message>
        <message>
            <source>manage accounts</source>
            <translation>hantera konton</translation>
        </message>
        <message>
            <source>marks of a photo</source>
            <translation>fotots märken</translation>
        </message>
        <message>
            <source>mean of first minus second</source>
            <translation>medelvärde av första minus andra</translation>
        </message>
        <message>
            <source>mean of the absolute difference</source>
            <translation>medelvärde av skillnadens belopp</translation>
        </message>
        <message>
            <source>mean {mean:.2f} mm, 95 % {p95:.2f} mm, largest {max:.2f} mm, signed mean {signed:+.2f} mm</source>
            <translation>medel {mean:.2f} mm, 95 % {p95:.2f} mm, störst {max:.2f} mm, medel med tecken {signed:+.2f} mm</translation>
        </message>
        <message>
            <source>measures</source>
            <translation>mått</translation>
        </message>
        <message>
            <source>medial</source>
            <translation>medial</translation>
        </message>
        <message>
            <source>medial flange</source>
            <translation>medial fläns</translation>
        </message>
        <message>
            <source>medial rim</source>
            <translation>medial kant</translation>
        </message>
        <message>
            <source>medially</source>
            <translation>medialt</translation>
        </message>
        <message>
            <source>median</source>
            <translation>median</translation>
        </message>
        <message>
            <source>men's: the English size and one</source>
            <translation>herr: den engelska storleken plus ett</translation>
        </message>
        <message>
            <source>merge patients</source>
            <translation>slå ihop patienter</translation>
        </message>
        <message>
            <source>merged</source>
            <translation>sammanslagen</translation>
        </message>
        <message>
            <source>metatarsal bar</source>
            <translation>tvärbalk</translation>
        </message>
        <message>
            <source>metatarsal head</source>
            <translation>metatarsalhuvud</translation>
        </message>
        <message>
            <source>metatarsale tibiale to metatarsale fibulare, seen from below</source>
            <translation>metatarsale tibiale till metatarsale fibulare, sett underifrån</translation>
        </message>
        <message>
            <source>method</source>
            <translation>metod</translation>
        </message>
        <message>
            <source>metres</source>
            <translation>meter</translation>
        </message>
        <message>
            <source>middle centre</source>
            <translation>mitten</translation>
        </message>
        <message>
            <source>middle left</source>
            <translation>mitten till vänster</translation>
        </message>
        <message>
            <source>middle right</source>
            <translation>mitten till höger</translation>
        </message>
        <message>
            <source>middle third of the toeless footprint / all of it</source>
            <translation>mittersta tredjedelen av fotavtrycket utan tår / hela avtrycket</translation>
        </message>
        <message>
            <source>milled</source>
            <translation>fräst</translation>
        </message>
        <message>
            <source>millimetres</source>
            <translation>millimeter</translation>
        </message>
        <message>
            <source>mirror image of the {side} foot</source>
            <translation>spegelbild av den andra foten ({side})</translation>
        </message>
        <message>
            <source>mirrored, {how}</source>
            <translation>speglad, {how}</translation>
        </message>
        <message>
            <source>mm high</source>
            <translation>mm högt</translation>
        </message>
        <message>
            <source>mm of material left by the {diameter_mm:g} mm cutter in a hollow</source>
            <translation>mm material som fräsen på {diameter_mm:g} mm lämnar i en fördjupning</translation>
        </message>
        <message>
            <source>mm of rise over 1 mm</source>
            <translation>mm stigning på 1 mm</translation>
        </message>
        <message>
            <source>mm thick</source>
            <translation>mm tjockt</translation>
        </message>
        <message>
            <source>mm uncertain at the foot</source>
            <translation>mm osäkert vid foten</translation>
        </message>
        <message>
            <source>mode</source>
            <translation>läge</translation>
        </message>
        <message>
            <source>mondopoint</source>
            <translation>mondopoint</translation>
        </message>
        <message>
            <source>mortons extension</source>
            <translation>Mortons förlängning</translation>
        </message>
        <message>
            <source>most</source>
            <translation>största</translation>
        </message>
        <message>
            <source>mould</source>
            <translation>gjutform</translation>
        </message>
        <message>
            <source>moved</source>
            <translation>flyttad</translation>
        </message>
        <message>
            <source>must be 64 digits and letters a to f</source>
            <translation>måste vara 64 siffror och bokstäver a till f</translation>
        </message>
        <message>
            <source>must be a day such as 2026-11-20, or null</source>
            <translation>måste vara en dag som 2026-11-20, eller null</translation>
        </message>
        <message>
            <source>must be a list […]</source>
            <translation>måste vara en lista […]</translation>
        </message>
        <message>
            <source>must be a list of three corners or more</source>
            <translation>måste vara en lista med tre hörn eller fler</translation>
        </message>
        <message>
            <source>must be a text</source>
            <translation>måste vara en text</translation>
        </message>
        <message>
            <source>must be a text that is not empty</source>
            <translation>måste vara en text som inte är tom</translation>
        </message>
        <message>
            <source>must be a {size}×{size} matrix</source>
            <translation>måste vara en {size}×{size}-matris</translation>
        </message>
        <message>
            <source>must be above 0 and at most 100</source>
            <translation>måste vara över 0 och högst 100</translation>
        </message>
        <message>
            <source>must be above from_kpa</source>
            <translation>måste vara större än from_kpa</translation>
        </message>
        <message>
            <source>must be an object {…}</source>
            <translation>måste vara ett objekt {…}</translation>
        </message>
        <message>
            <source>must be pairs of numbers</source>
            <translation>måste vara par av tal</translation>
        </message>
        <message>
            <source>must be three lengths above 0</source>
            <translation>måste vara tre längder över 0</translation>
        </message>
        <message>
            <source>must be three numbers of 0 to 255</source>
            <translation>måste vara tre tal från 0 till 255</translation>
        </message>
        <message>
            <source>must go from light to heavy, and end with a step without up_to_kg</source>
            <translation>måste gå från lätt till tung, och sluta med ett steg utan up_to_kg</translation>
        </message>
        <message>
            <source>must have min below max in x, y and z</source>
            <translation>måste ha min under max i x, y och z</translation>
        </message>
        <message>
            <source>must hold at least 8 stations, from along 0 at the heel to 1 at the toes</source>
            <translation>måste hålla minst 8 stationer, från along 0 vid hälen till 1 vid tårna</translation>
        </message>
        <message>
            <source>must hold at least one item</source>
            <translation>måste ha minst en post</translation>
        </message>
        <message>
            <source>must hold at least one prescription</source>
            <translation>måste innehålla minst en ordination</translation>
        </message>
        <message>
            <source>must hold one of the name "regular"</source>
            <translation>måste hålla en med namnet ”regular”</translation>
        </message>
        <message>
            <source>must lie at smaller x than the right foot, since +x points to the patient's right</source>
            <translation>måste ligga vid mindre x än högerfoten, eftersom +x pekar åt patientens höger</translation>
        </message>
        <message>
            <source>must name a file beside sensor.json</source>
            <translation>måste ange en fil bredvid sensor.json</translation>
        </message>
        <message>
            <source>must name at least one marker group</source>
            <translation>måste ange minst en markörgrupp</translation>
        </message>
        <message>
            <source>must name at least one view, and none twice</source>
            <translation>måste ange minst en vy, och ingen två gånger</translation>
        </message>
        <message>
            <source>must name left, right, or both, each once</source>
            <translation>måste ange left, right eller båda, var och en en gång</translation>
        </message>
        <message>
            <source>name</source>
            <translation>namn</translation>
        </message>
        <message>
            <source>name a foot that the item does not order</source>
            <translation>anger en fot som posten inte beställer</translation>
        </message>
        <message>
            <source>name and birth date</source>
            <translation>namn och födelsedatum</translation>
        </message>
        <message>
            <source>name of the file</source>
            <translation>Filens namn</translation>
        </message>
        <message>
            <source>name of the material</source>
            <translation>Materialets namn</translation>
        </message>
        <message>
            <source>name of the shop</source>
            <translation>verkstadens namn</translation>
        </message>
        <message>
            <source>name of who released the order</source>
            <translation>namnet på den som frisläppte beställningen</translation>
        </message>
        <message>
            <source>name the same point twice</source>
            <translation>namnger samma punkt två gånger</translation>
        </message>
        <message>
            <source>named at each view</source>
            <translation>anges vid varje vy</translation>
        </message>
        <message>
            <source>names "{unknown}", which no marker in manifest.json has</source>
            <translation>anger ”{unknown}”, som ingen markör i manifest.json har</translation>
        </message>
        <message>
            <source>names a marker twice</source>
            <translation>anger en markör två gånger</translation>
        </message>
        <message>
            <source>names a side that is not ordered</source>
            <translation>nämner en sida som inte är beställd</translation>
        </message>
        <message>
            <source>names one material twice; keep one of them</source>
            <translation>anger ett material två gånger; behåll ett av dem</translation>
        </message>
        <message>
            <source>names one preset twice; keep one of them</source>
            <translation>nämner en förinställning två gånger; behåll en av dem</translation>
        </message>
        <message>
            <source>names the same marker id twice</source>
            <translation>anger samma markör-id två gånger</translation>
        </message>
        <message>
            <source>names {marker!r}, which no marker of this session is</source>
            <translation>anger {marker!r}, som ingen markör i denna session är</translation>
        </message>
        <message>
            <source>names {name!r}, but a view has 1 to 32 of the letters a-z, 0-9 and _</source>
            <translation>anger {name!r}, men en vy har 1 till 32 av tecknen a-z, 0-9 och _</translation>
        </message>
        <message>
            <source>names {name} twice; keep one of them</source>
            <translation>nämner {name} två gånger; behåll en av dem</translation>
        </message>
        <message>
            <source>narrow</source>
            <translation>smal</translation>
        </message>
        <message>
            <source>navicular height</source>
            <translation>navikularhöjd</translation>
        </message>
        <message>
            <source>navicular, where it is marked, over the ground</source>
            <translation>naviculare, där det är märkt, över underlaget</translation>
        </message>
        <message>
            <source>neuroma</source>
            <translation>neurom</translation>
        </message>
        <message>
            <source>neuropathy</source>
            <translation>neuropati</translation>
        </message>
        <message>
            <source>new</source>
            <translation>nya</translation>
        </message>
        <message>
            <source>no</source>
            <translation>nej</translation>
        </message>
        <message>
            <source>no OpenGL</source>
            <translation>ingen OpenGL</translation>
        </message>
        <message>
            <source>no blue marker with a depth reading is seen; check the light and that the reference system is in the picture</source>
            <translation>ingen blå markör med djupvärde syns; kontrollera ljuset och att referenssystemet är i bild</translation>
        </message>
        <message>
            <source>no edge has {room:g} mm free: hold the block from its sides or from below, such as by vacuum or tape</source>
            <translation>ingen kant har {room:g} mm fritt: håll blocket från sidorna eller underifrån, till exempel med vakuum eller tejp</translation>
        </message>
        <message>
            <source>no good backup</source>
            <translation>ingen felfri säkerhetskopia</translation>
        </message>
        <message>
            <source>no length between two of its markers was given; measure one by hand.</source>
            <translation>ingen längd mellan två av dess markörer angavs; mät en för hand.</translation>
        </message>
        <message>
            <source>no pattern of dots of the sensor lies beside the infrared pictures; learn it by calibrate infrared --keep, and put it in by calibrate session.</source>
            <translation>inget punktmönster för sensorn ligger bredvid de infraröda bilderna; lär in det med calibrate infrared --keep och lägg in det med calibrate session.</translation>
        </message>
        <message>
            <source>no sensor is calibrated on this computer</source>
            <translation>ingen sensor är kalibrerad på den här datorn</translation>
        </message>
        <message>
            <source>none</source>
            <translation>–</translation>
        </message>
        <message>
            <source>none is plugged in</source>
            <translation>ingen är ansluten</translation>
        </message>
        <message>
            <source>none of its own: this foot is a mirror image of the other one</source>
            <translation>inga egna: den här foten är en spegelbild av den andra</translation>
        </message>
        <message>
            <source>none stated</source>
            <translation>ingen angiven</translation>
        </message>
        <message>
            <source>none yet</source>
            <translation>ingen ännu</translation>
        </message>
        <message>
            <source>none yet; the defaults hold</source>
            <translation>inga ännu; standardvärdena gäller</translation>
        </message>
        <message>
            <source>not examined, because there is no screen</source>
            <translation>inte undersökt, eftersom det inte finns någon skärm</translation>
        </message>
        <message>
            <source>not known</source>
            <translation>okänd</translation>
        </message>
        <message>
            <source>not recorded</source>
            <translation>inte antecknat</translation>
        </message>
        <message>
            <source>not scanned</source>
            <translation>inte skannat</translation>
        </message>
        <message>
            <source>not set up</source>
            <translation>inte inrättad</translation>
        </message>
        <message>
            <source>notes</source>
            <translation>anteckningar</translation>
        </message>
        <message>
            <source>nothing has to be milled with this cutter: do not run it</source>
            <translation>inget ska fräsas med denna fräs: kör det inte</translation>
        </message>
        <message>
            <source>number</source>
            <translation>nummer</translation>
        </message>
        <message>
            <source>number of an order</source>
            <translation>beställningsnummer</translation>
        </message>
        <message>
            <source>number of colour frames</source>
            <translation>antalet färgbilder</translation>
        </message>
        <message>
            <source>number of depth frames</source>
            <translation>antalet djupbilder</translation>
        </message>
        <message>
            <source>number of infrared pictures</source>
            <translation>antalet infraröda bilder</translation>
        </message>
        <message>
            <source>number of places each sensor stands in</source>
            <translation>antalet platser som varje sensor står på</translation>
        </message>
        <message>
            <source>number of the order</source>
            <translation>Beställningens nummer</translation>
        </message>
        <message>
            <source>occupation</source>
            <translation>yrke</translation>
        </message>
        <message>
            <source>of unknown age</source>
            <translation>av okänd ålder</translation>
        </message>
        <message>
            <source>on free edges alone ({edges}), and no higher than {safe} mm above the block</source>
            <translation>bara på fria kanter ({edges}), och högst {safe} mm ovanför blocket</translation>
        </message>
        <message>
            <source>on free edges alone ({edges}), beside the dowels, and no higher than {safe} mm above the block</source>
            <translation>bara på fria kanter ({edges}), bredvid styrpinnarna och högst {safe} mm ovanför blocket</translation>
        </message>
        <message>
            <source>on the server {place}, which answers</source>
            <translation>på servern {place}, som svarar</translation>
        </message>
        <message>
            <source>one number</source>
            <translation>ett tal</translation>
        </message>
        <message>
            <source>one of its arrays is longer than the bytes it holds</source>
            <translation>en av dess talföljder är längre än de byte den innehåller</translation>
        </message>
        <message>
            <source>one of its arrays is of the type {type}</source>
            <translation>en av dess talföljder är av typen {type}</translation>
        </message>
        <message>
            <source>one of its chunks is cut off</source>
            <translation>ett av dess block är avklippt</translation>
        </message>
        <message>
            <source>only {count:.0f} of its markers have a depth reading; see that more markers are in view</source>
            <translation>bara {count:.0f} av dess markörer har ett djupvärde; se till att fler markörer syns</translation>
        </message>
        <message>
            <source>only {left} of the {count} markers are left after the corrections by hand ({corrections}), and {least} are needed; include or add markers</source>
            <translation>bara {left} av de {count} markörerna är kvar efter handkorrigeringarna ({corrections}), och {least} behövs; ta med eller lägg till markörer</translation>
        </message>
        <message>
            <source>only {most} of the {spots} blue spots fit the {markers} markers, and {needed} are needed; check that it is the right reference system and that most markers are seen</source>
            <translation>bara {most} av de {spots} blå fläckarna passar de {markers} markörerna, och {needed} behövs; kontrollera att det är rätt referenssystem och att de flesta markörer syns</translation>
        </message>
        <message>
            <source>only {most} of the {spots} blue spots fit the {markers} markers, and {needed} are needed; check that it is the right reference system, that its pictures are not mirrored and that most markers are seen</source>
            <translation>bara {most} av de {spots} blå fläckarna passar de {markers} markörerna, och {needed} behövs; kontrollera att det är rätt referenssystem, att bilderna inte är spegelvända och att de flesta markörer syns</translation>
        </message>
        <message>
            <source>only {used} of the {count} markers agree with each other in the colour image ({worst}); check that the reference system was not changed or moved</source>
            <translation>bara {used} av de {count} markörerna stämmer med varandra i färgbilden ({worst}); kontrollera att referenssystemet inte ändrats eller flyttats</translation>
        </message>
        <message>
            <source>order</source>
            <translation>beställning</translation>
        </message>
        <message>
            <source>orthopedist</source>
            <translation>ortopedingenjör</translation>
        </message>
        <message>
            <source>outcome</source>
            <translation>resultat</translation>
        </message>
        <message>
            <source>outer edge of the foot</source>
            <translation>fotens utsida</translation>
        </message>
        <message>
            <source>outline</source>
            <translation>kontur</translation>
        </message>
        <message>
            <source>outline_mm{where} belongs to the shapes "outline" and "flat_outline" and to no other; draw an outline, or choose another shape and leave it out.</source>
            <translation>outline_mm{where} hör till formerna ”outline” och ”flat_outline” och ingen annan; rita en kontur, eller välj en annan form och utelämna den.</translation>
        </message>
        <message>
            <source>outline_mm{where} crosses itself; draw the outline again in one round.</source>
            <translation>outline_mm{where} korsar sig själv; rita konturen igen i ett varv.</translation>
        </message>
        <message>
            <source>outline_mm{where} does not go round the pad's centre; put the apex into the outline.</source>
            <translation>outline_mm{where} går inte runt pelottens mitt; lägg toppen innanför konturen.</translation>
        </message>
        <message>
            <source>oval</source>
            <translation>oval</translation>
        </message>
        <message>
            <source>oval pad</source>
            <translation>oval pelott</translation>
        </message>
        <message>
            <source>pads</source>
            <translation>pelotter</translation>
        </message>
        <message>
            <source>page</source>
            <translation>sida</translation>
        </message>
        <message>
            <source>pediatric</source>
            <translation>pediatrisk</translation>
        </message>
        <message>
            <source>pelott</source>
            <translation>pelott</translation>
        </message>
        <message>
            <source>peroneal tendon</source>
            <translation>peroneussena</translation>
        </message>
        <message>
            <source>person</source>
            <translation>person</translation>
        </message>
        <message>
            <source>personal number</source>
            <translation>personnummer</translation>
        </message>
        <message>
            <source>pes cavus</source>
            <translation>pes cavus</translation>
        </message>
        <message>
            <source>pes planovalgus</source>
            <translation>pes planovalgus</translation>
        </message>
        <message>
            <source>pes planus</source>
            <translation>pes planus</translation>
        </message>
        <message>
            <source>pes transversus</source>
            <translation>pes transversus</translation>
        </message>
        <message>
            <source>photo</source>
            <translation>foto</translation>
        </message>
        <message>
            <source>pictures</source>
            <translation>bilder</translation>
        </message>
        <message>
            <source>pictures named {prefix}…</source>
            <translation>bilder med namnet {prefix}…</translation>
        </message>
        <message>
            <source>pictures of different positions may have been put together, or the board was hardly turned, so take them again</source>
            <translation>bilder av olika lägen kan ha hamnat ihop, eller så vreds brädet knappt, så ta dem igen</translation>
        </message>
        <message>
            <source>piece that floats</source>
            <translation>svävande bit</translation>
        </message>
        <message>
            <source>pieces that float</source>
            <translation>svävande bitar</translation>
        </message>
        <message>
            <source>place and follow orders</source>
            <translation>lägga och följa beställningar</translation>
        </message>
        <message>
            <source>plane</source>
            <translation>plan yta</translation>
        </message>
        <message>
            <source>plantar fasciosis</source>
            <translation>plantar fascios</translation>
        </message>
        <message>
            <source>plantar heel pain</source>
            <translation>smärta under hälen</translation>
        </message>
        <message>
            <source>plate</source>
            <translation>platta</translation>
        </message>
        <message>
            <source>points</source>
            <translation>punkter</translation>
        </message>
        <message>
            <source>points_mm of outline has {count} places, and a drawn outline needs at least {least}; draw it again.</source>
            <translation>points_mm i outline har {count} platser, och en ritad kontur behöver minst {least}; rita den igen.</translation>
        </message>
        <message>
            <source>polypropylene</source>
            <translation>polypropen</translation>
        </message>
        <message>
            <source>positive</source>
            <translation>formen</translation>
        </message>
        <message>
            <source>posting</source>
            <translation>kilning</translation>
        </message>
        <message>
            <source>posts of shell holds two for one region; keep one of them.</source>
            <translation>posts i shell har två för samma område; behåll en av dem.</translation>
        </message>
        <message>
            <source>prescribed thickness</source>
            <translation>ordinerad tjocklek</translation>
        </message>
        <message>
            <source>prescription</source>
            <translation>ordination</translation>
        </message>
        <message>
            <source>pressure sore</source>
            <translation>trycksår</translation>
        </message>
        <message>
            <source>printed</source>
            <translation>utskrivet</translation>
        </message>
        <message>
            <source>pronation</source>
            <translation>pronation</translation>
        </message>
        <message>
            <source>pseudonym</source>
            <translation>pseudonym</translation>
        </message>
        <message>
            <source>pternion to metatarsale tibiale, along the foot axis</source>
            <translation>pternion till metatarsale tibiale, längs fotaxeln</translation>
        </message>
        <message>
            <source>pternion to the tip of the longest toe, along the foot axis</source>
            <translation>pternion till den längsta tåns spets, längs fotaxeln</translation>
        </message>
        <message>
            <source>pull</source>
            <translation>dra ner</translation>
        </message>
        <message>
            <source>push</source>
            <translation>tryck upp</translation>
        </message>
        <message>
            <source>push-off</source>
            <translation>frånskjut</translation>
        </message>
        <message>
            <source>px apart in the colour image</source>
            <translation>px isär i färgbilden</translation>
        </message>
        <message>
            <source>raise</source>
            <translation>höj</translation>
        </message>
        <message>
            <source>read the audit log</source>
            <translation>läsa loggen</translation>
        </message>
        <message>
            <source>readable</source>
            <translation>läsbara</translation>
        </message>
        <message>
            <source>rearfoot</source>
            <translation>bakfot</translation>
        </message>
        <message>
            <source>rearfoot angle</source>
            <translation>bakfotsvinkel</translation>
        </message>
        <message>
            <source>rearfoot angle deg</source>
            <translation>bakfotsvinkel, °</translation>
        </message>
        <message>
            <source>rearfoot eversion of the simulated foot (degrees)</source>
            <translation>den simulerade fotens bakfotseversion (grader)</translation>
        </message>
        <message>
            <source>rearfoot post</source>
            <translation>bakfotskil</translation>
        </message>
        <message>
            <source>rearmost point</source>
            <translation>bakersta punkten</translation>
        </message>
        <message>
            <source>reason</source>
            <translation>orsak</translation>
        </message>
        <message>
            <source>reason for the export</source>
            <translation>Skälet till exporten</translation>
        </message>
        <message>
            <source>record</source>
            <translation>journal</translation>
        </message>
        <message>
            <source>redacted</source>
            <translation>avidentifierad</translation>
        </message>
        <message>
            <source>refused</source>
            <translation>avvisade</translation>
        </message>
        <message>
            <source>regular</source>
            <translation>normal</translation>
        </message>
        <message>
            <source>released by</source>
            <translation>frisläppt av</translation>
        </message>
        <message>
            <source>relief at the base of the 5th metatarsal</source>
            <translation>avlastning vid femte metatarsalbenets bas</translation>
        </message>
        <message>
            <source>relief under the 1st head</source>
            <translation>avlastning under första huvudet</translation>
        </message>
        <message>
            <source>relief under the 1st toe</source>
            <translation>avlastning under första tån</translation>
        </message>
        <message>
            <source>relief under the 2nd head</source>
            <translation>avlastning under andra huvudet</translation>
        </message>
        <message>
            <source>relief under the 2nd toe</source>
            <translation>avlastning under andra tån</translation>
        </message>
        <message>
            <source>relief under the 3rd head</source>
            <translation>avlastning under tredje huvudet</translation>
        </message>
        <message>
            <source>relief under the 3rd toe</source>
            <translation>avlastning under tredje tån</translation>
        </message>
        <message>
            <source>relief under the 4th head</source>
            <translation>avlastning under fjärde huvudet</translation>
        </message>
        <message>
            <source>relief under the 4th toe</source>
            <translation>avlastning under fjärde tån</translation>
        </message>
        <message>
            <source>relief under the 5th head</source>
            <translation>avlastning under femte huvudet</translation>
        </message>
        <message>
            <source>relief under the 5th toe</source>
            <translation>avlastning under femte tån</translation>
        </message>
        <message>
            <source>remarks</source>
            <translation>anmärkningar</translation>
        </message>
        <message>
            <source>reset password</source>
            <translation>återställde lösenordet</translation>
        </message>
        <message>
            <source>resolution of the foot's surface (mm)</source>
            <translation>upplösningen på fotens yta (mm)</translation>
        </message>
        <message>
            <source>rest</source>
            <translation>resten</translation>
        </message>
        <message>
            <source>restored</source>
            <translation>återställd</translation>
        </message>
        <message>
            <source>returned</source>
            <translation>returnerad</translation>
        </message>
        <message>
            <source>reverse Morton's extension</source>
            <translation>omvänd Mortons förlängning</translation>
        </message>
        <message>
            <source>revised</source>
            <translation>reviderad</translation>
        </message>
        <message>
            <source>right</source>
            <translation>höger</translation>
        </message>
        <message>
            <source>right foot</source>
            <translation>höger fot</translation>
        </message>
        <message>
            <source>right insole</source>
            <translation>höger inlägg</translation>
        </message>
        <message>
            <source>right sole</source>
            <translation>höger fotsula</translation>
        </message>
        <message>
            <source>rigid</source>
            <translation>styv</translation>
        </message>
        <message>
            <source>rim of finish has {count} stations, and may have {most}; remove some.</source>
            <translation>rim i finish har {count} stationer och får ha {most}; ta bort några.</translation>
        </message>
        <message>
            <source>rocker</source>
            <translation>rullsula</translation>
        </message>
        <message>
            <source>running</source>
            <translation>löpning</translation>
        </message>
        <message>
            <source>scan of the earlier visit</source>
            <translation>skanning från det tidigare besöket</translation>
        </message>
        <message>
            <source>scar</source>
            <translation>ärr</translation>
        </message>
        <message>
            <source>sealed</source>
            <translation>förseglad</translation>
        </message>
        <message>
            <source>second</source>
            <translation>andra</translation>
        </message>
        <message>
            <source>see patients</source>
            <translation>se patienter</translation>
        </message>
        <message>
            <source>see the job sheet</source>
            <translation>se arbetsbladet</translation>
        </message>
        <message>
            <source>see the next sheet</source>
            <translation>se nästa blad</translation>
        </message>
        <message>
            <source>seed of the foot</source>
            <translation>fotens frö</translation>
        </message>
        <message>
            <source>seed of the simulation</source>
            <translation>simuleringens frö</translation>
        </message>
        <message>
            <source>seen</source>
            <translation>sedd</translation>
        </message>
        <message>
            <source>seen from above with the toes ahead, the big toe and the high side of the arch lie on the {direction}</source>
            <translation>sett uppifrån med tårna framåt ligger stortån och valvets höga sida åt {direction}</translation>
        </message>
        <message>
            <source>seen from above, its outline is that of such a foot rather than another</source>
            <translation>sett uppifrån liknar konturen en sådan fot mer än en annan</translation>
        </message>
        <message>
            <source>seen in part only, and continued by the usual shape: {places}</source>
            <translation>bara delvis sett, och fortsatt med den vanliga formen: {places}</translation>
        </message>
        <message>
            <source>selects {word}, and the program is made for {chosen}; take that word out, or set work_offset</source>
            <translation>väljer {word}, och programmet görs för {chosen}; ta bort det ordet eller ange work_offset</translation>
        </message>
        <message>
            <source>semi-weight-bearing</source>
            <translation>delvis belastad</translation>
        </message>
        <message>
            <source>sends no infrared pictures; choose one that does</source>
            <translation>sänder inga infraröda bilder; välj en som gör det</translation>
        </message>
        <message>
            <source>sends no pair of infrared pictures; start it with them</source>
            <translation>skickar inget par av infraröda bilder; starta den med dem</translation>
        </message>
        <message>
            <source>sensors</source>
            <translation>sensorer</translation>
        </message>
        <message>
            <source>sent</source>
            <translation>skickad</translation>
        </message>
        <message>
            <source>sesamoid</source>
            <translation>sesamben</translation>
        </message>
        <message>
            <source>set up backups</source>
            <translation>förberedde säkerhetskopior</translation>
        </message>
        <message>
            <source>settled</source>
            <translation>avgjord</translation>
        </message>
        <message>
            <source>shape</source>
            <translation>form</translation>
        </message>
        <message>
            <source>shell</source>
            <translation>skal</translation>
        </message>
        <message>
            <source>shoe</source>
            <translation>sko</translation>
        </message>
        <message>
            <source>shoe height</source>
            <translation>skohöjd</translation>
        </message>
        <message>
            <source>shoe size</source>
            <translation>skostorlek</translation>
        </message>
        <message>
            <source>shoe size eu</source>
            <translation>skostorlek EU</translation>
        </message>
        <message>
            <source>shoe size uk</source>
            <translation>skostorlek UK</translation>
        </message>
        <message>
            <source>shoe size us</source>
            <translation>skostorlek US</translation>
        </message>
        <message>
            <source>shoe_size_eu of outline is missing; put in the size of the shoe.</source>
            <translation>shoe_size_eu i outline saknas; ange skons storlek.</translation>
        </message>
        <message>
            <source>short leg</source>
            <translation>kort ben</translation>
        </message>
        <message>
            <source>side must be "left" or "right", and is {value}.</source>
            <translation>side måste vara ”left” eller ”right”, och är {value}.</translation>
        </message>
        <message>
            <source>sign prescriptions</source>
            <translation>signera ordinationer</translation>
        </message>
        <message>
            <source>signature</source>
            <translation>signatur</translation>
        </message>
        <message>
            <source>signature {signature}</source>
            <translation>signatur {signature}</translation>
        </message>
        <message>
            <source>signed</source>
            <translation>signerad</translation>
        </message>
        <message>
            <source>signed by</source>
            <translation>signerad av</translation>
        </message>
        <message>
            <source>signed by {name} on {day}</source>
            <translation>signerad av {name} {day}</translation>
        </message>
        <message>
            <source>signed in</source>
            <translation>inloggad</translation>
        </message>
        <message>
            <source>slim shoe</source>
            <translation>smal sko</translation>
        </message>
        <message>
            <source>slope</source>
            <translation>lutning</translation>
        </message>
        <message>
            <source>smaller</source>
            <translation>mindre</translation>
        </message>
        <message>
            <source>smooth</source>
            <translation>jämna</translation>
        </message>
        <message>
            <source>smooth map that varies with disparity</source>
            <translation>jämn karta som ändras med disparitet</translation>
        </message>
        <message>
            <source>soft</source>
            <translation>mjuk</translation>
        </message>
        <message>
            <source>something moved by {distance_mm:.1f} mm; {moved} of its {frames} depth frames are left out</source>
            <translation>något rörde sig {distance_mm:.1f} mm; {moved} av dess {frames} djupbilder utelämnas</translation>
        </message>
        <message>
            <source>something moved in {moved} of its {frames} depth frames; capture it again with the foot kept still</source>
            <translation>något rörde sig i {moved} av dess {frames} djupbilder; ta om den med foten stilla</translation>
        </message>
        <message>
            <source>something moved; {moved} of its {frames} depth frames are left out</source>
            <translation>något rörde sig; {moved} av dess {frames} djupbilder utelämnas</translation>
        </message>
        <message>
            <source>sphere</source>
            <translation>kula</translation>
        </message>
        <message>
            <source>spoil board: holes for the dowels</source>
            <translation>offerskiva: hål för styrpinnarna</translation>
        </message>
        <message>
            <source>sprain</source>
            <translation>stukning</translation>
        </message>
        <message>
            <source>state of the capture</source>
            <translation>avbildningens läge</translation>
        </message>
        <message>
            <source>step</source>
            <translation>steg</translation>
        </message>
        <message>
            <source>stereo</source>
            <translation>färg mot djup</translation>
        </message>
        <message>
            <source>stiff toe joint</source>
            <translation>stel tåled</translation>
        </message>
        <message>
            <source>strength</source>
            <translation>styrka</translation>
        </message>
        <message>
            <source>strength{where} is {strength:g}, and for smoothing must be 0 to 1; 1 evens out all it can.</source>
            <translation>strength{where} är {strength:g}, och måste för utjämning vara 0 till 1; 1 jämnar ut allt den kan.</translation>
        </message>
        <message>
            <source>sulcus</source>
            <translation>tåfåra</translation>
        </message>
        <message>
            <source>supination</source>
            <translation>supination</translation>
        </message>
        <message>
            <source>swept</source>
            <translation>städad</translation>
        </message>
        <message>
            <source>switched off</source>
            <translation>avstängd</translation>
        </message>
        <message>
            <source>switched on</source>
            <translation>slogs på</translation>
        </message>
        <message>
            <source>tape round the foot through the two points of the ball</source>
            <translation>måttband runt foten genom trampdynans två punkter</translation>
        </message>
        <message>
            <source>technician</source>
            <translation>tekniker</translation>
        </message>
        <message>
            <source>tendon</source>
            <translation>sena</translation>
        </message>
        <message>
            <source>terms of the order</source>
            <translation>beställningens villkor</translation>
        </message>
        <message>
            <source>text of the mark</source>
            <translation>märkets text</translation>
        </message>
        <message>
            <source>text on the bottom</source>
            <translation>Texten på undersidan</translation>
        </message>
        <message>
            <source>the angle between the cameras</source>
            <translation>vinkeln mellan kamerorna</translation>
        </message>
        <message>
            <source>the back of the foot was not scanned</source>
            <translation>fotens baksida skannades inte</translation>
        </message>
        <message>
            <source>the back of the heel or the leg was not scanned, or in pieces only</source>
            <translation>hälens baksida eller benet skannades inte, eller bara i bitar</translation>
        </message>
        <message>
            <source>the back of the heel or the leg was seen in part only</source>
            <translation>hälens baksida eller benet sågs bara delvis</translation>
        </message>
        <message>
            <source>the backups cannot be looked at</source>
            <translation>säkerhetskopiorna kan inte granskas</translation>
        </message>
        <message>
            <source>the blue spots are the mirror image of the markers; check whether the pictures of this view were flipped; as they stand they fit no pose</source>
            <translation>de blå fläckarna är spegelbilden av markörerna; kontrollera om vyns bilder är spegelvända; som de är passar de inget läge</translation>
        </message>
        <message>
            <source>the blue spots fit the markers in two ways, {most} and {rivals} of them; see that more markers are in view</source>
            <translation>de blå fläckarna passar markörerna på två sätt, {most} och {rivals} av dem; se till att fler markörer syns</translation>
        </message>
        <message>
            <source>the blue spots lie {rms_px:.1f} px from where the markers should be seen; check that it is the right reference system and the right calibration</source>
            <translation>de blå fläckarna ligger {rms_px:.1f} px från där markörerna borde synas; kontrollera att referenssystemet och kalibreringen är de rätta</translation>
        </message>
        <message>
            <source>the body of {name} as it was printed ({off})</source>
            <translation>kroppen i {name} så som den skrevs ut ({off})</translation>
        </message>
        <message>
            <source>the clinic's own judgement</source>
            <translation>klinikens egen bedömning</translation>
        </message>
        <message>
            <source>the corner of the block with least x and y, its upper side</source>
            <translation>blockets hörn med minst x och y, dess ovansida</translation>
        </message>
        <message>
            <source>the corner of the block with least x and y, the surface of the board</source>
            <translation>blockets hörn med minst x och y, skivans yta</translation>
        </message>
        <message>
            <source>the depth is {percent:.1f} % {direction} than the markers in the colour image say, and is corrected by that; calibrate the sensor, and see that the session has the right reference system</source>
            <translation>djupet är {percent:.1f} % {direction} än markörerna i färgbilden säger, och rättas med så mycket; kalibrera sensorn, och se till att sessionen har rätt referenssystem</translation>
        </message>
        <message>
            <source>the distance between the cameras</source>
            <translation>avståndet mellan kamerorna</translation>
        </message>
        <message>
            <source>the distance of the sensors</source>
            <translation>sensorernas avstånd</translation>
        </message>
        <message>
            <source>the distances are in another order than the captures ({capture} is about {usual_mm:.0f} mm away, but {given_mm:.0f} mm was given), so give one for each, in the order of their names</source>
            <translation>avstånden står i en annan ordning än bilderna ({capture} är omkring {usual_mm:.0f} mm bort, men {given_mm:.0f} mm angavs), så ange ett för varje, i namnens ordning</translation>
        </message>
        <message>
            <source>the distortion of the depth is corrected by what was measured on sensor {owner}, not on {serial}, so the depth may be wrong by several millimetres; give the session the calibration of its own sensor</source>
            <translation>djupets distorsion rättas med vad som mättes på sensor {owner}, inte på {serial}, så djupet kan vara flera millimeter fel; ge sessionen kalibreringen från dess egen sensor</translation>
        </message>
        <message>
            <source>the distortion of the depth was not corrected yet, so calibrate it first</source>
            <translation>djupets förvrängning är inte korrigerad ännu, så kalibrera den först</translation>
        </message>
        <message>
            <source>the face has {count} markers, but at least {least} are needed</source>
            <translation>sidan har {count} markörer, men minst {least} behövs</translation>
        </message>
        <message>
            <source>the file {name} is not beside it</source>
            <translation>filen {name} ligger inte bredvid den</translation>
        </message>
        <message>
            <source>the focal length of the colour camera</source>
            <translation>färgkamerans brännvidd</translation>
        </message>
        <message>
            <source>the focal length of the depth camera</source>
            <translation>djupkamerans brännvidd</translation>
        </message>
        <message>
            <source>the foot is cut off at the {edges} edge of the depth picture; turn the sensor or move it back</source>
            <translation>foten är avskuren vid djupbildens kant ({edges}); vrid sensorn eller flytta den bakåt</translation>
        </message>
        <message>
            <source>the foot itself</source>
            <translation>foten själv</translation>
        </message>
        <message>
            <source>the form {form}</source>
            <translation>formen {form}</translation>
        </message>
        <message>
            <source>the form {form}, {percent:g} % from the foot</source>
            <translation>formen {form}, {percent:g} % från foten</translation>
        </message>
        <message>
            <source>the heel or the medial side of the ball was not scanned</source>
            <translation>hälen eller trampdynans mediala sida skannades inte</translation>
        </message>
        <message>
            <source>the heel or the toes were not scanned</source>
            <translation>hälen eller tårna skannades inte</translation>
        </message>
        <message>
            <source>the heel or the toes were not scanned, or no shoe of adults is as long</source>
            <translation>hälen eller tårna skannades inte, eller ingen sko för vuxna är så lång</translation>
        </message>
        <message>
            <source>the infrared pictures are black; see that the emitter is on.</source>
            <translation>de infraröda bilderna är svarta; se till att strålaren är på.</translation>
        </message>
        <message>
            <source>the infrared pictures are saturated; lower their brightness, or keep sunlight off the foot.</source>
            <translation>de infraröda bilderna är mättade; sänk deras ljusstyrka, eller håll solljus borta från foten.</translation>
        </message>
        <message>
            <source>the key "{twice}" stands twice in one object; keep one.</source>
            <translation>nyckeln ”{twice}” står två gånger i ett objekt; behåll en.</translation>
        </message>
        <message>
            <source>the largest error of a distance</source>
            <translation>det största felet i ett avstånd</translation>
        </message>
        <message>
            <source>the largest offset that is left</source>
            <translation>den största förskjutning som återstår</translation>
        </message>
        <message>
            <source>the leg was not scanned</source>
            <translation>benet skannades inte</translation>
        </message>
        <message>
            <source>the leg was not scanned, or in pieces only</source>
            <translation>benet skannades inte, eller bara i bitar</translation>
        </message>
        <message>
            <source>the leg was not scanned, or in pieces only, or the scan does not stand upright</source>
            <translation>benet skannades inte, eller bara i bitar, eller så står skanningen inte upprätt</translation>
        </message>
        <message>
            <source>the length of the insole</source>
            <translation>inläggets längd</translation>
        </message>
        <message>
            <source>the list of materials beside an .obj; open that</source>
            <translation>materiallistan till en .obj; öppna den i stället</translation>
        </message>
        <message>
            <source>the maker</source>
            <translation>tillverkaren</translation>
        </message>
        <message>
            <source>the maker's address</source>
            <translation>tillverkarens adress</translation>
        </message>
        <message>
            <source>the marker {marker} was pointed at where the colour image shows nothing ({u:.0f}, {v:.0f}); point at it again</source>
            <translation>markören {marker} pekades ut där färgbilden inte visar något ({u:.0f}, {v:.0f}); peka ut den igen</translation>
        </message>
        <message>
            <source>the markers of the reference system "{system}" are not recognised: {reason}</source>
            <translation>markörerna i referenssystemet ”{system}” känns inte igen: {reason}</translation>
        </message>
        <message>
            <source>the markers that are seen lie almost on one line, so the sensor's place is uncertain</source>
            <translation>markörerna som syns ligger nästan på en linje, så sensorns plats är osäker</translation>
        </message>
        <message>
            <source>the markers {first} and {second} were pointed at in one place; point at each where it is</source>
            <translation>markörerna {first} och {second} pekades ut på samma ställe; peka ut var och en där den är</translation>
        </message>
        <message>
            <source>the middle of the block, its upper side</source>
            <translation>blockets mitt, dess ovansida</translation>
        </message>
        <message>
            <source>the middle of the block, the surface of the board</source>
            <translation>blockets mitt, skivans yta</translation>
        </message>
        <message>
            <source>the name is too long; choose a shorter one</source>
            <translation>namnet är för långt; välj ett kortare</translation>
        </message>
        <message>
            <source>the navicular is not marked</source>
            <translation>naviculare är inte märkt</translation>
        </message>
        <message>
            <source>the patient's name or a pseudonym</source>
            <translation>patientens namn eller en pseudonym</translation>
        </message>
        <message>
            <source>the pictures may be those of another camera, cut or scaled, or the board was hardly turned, so take them again</source>
            <translation>bilderna kan vara en annan kameras, beskurna eller skalade, eller så vreds brädet knappt, så ta dem igen</translation>
        </message>
        <message>
            <source>the place of a part in it is no number</source>
            <translation>läget för en del i den är inget tal</translation>
        </message>
        <message>
            <source>the place of an object in it is no number</source>
            <translation>läget för ett föremål i den är inget tal</translation>
        </message>
        <message>
            <source>the points may be assigned to the wrong places, or the cameras were not calibrated yet, so mark the points again</source>
            <translation>punkterna kan ha förväxlats, eller så är kamerorna inte kalibrerade ännu, så märk ut punkterna igen</translation>
        </message>
        <message>
            <source>the prescriber</source>
            <translation>ordinatören</translation>
        </message>
        <message>
            <source>the same two points, perpendicular to the foot axis</source>
            <translation>samma två punkter, vinkelrätt mot fotaxeln</translation>
        </message>
        <message>
            <source>the search limited to a region</source>
            <translation>sökningen begränsad till ett område</translation>
        </message>
        <message>
            <source>the sides of the ball were not scanned</source>
            <translation>trampdynans sidor skannades inte</translation>
        </message>
        <message>
            <source>the sides of the heel were not scanned</source>
            <translation>hälens sidor skannades inte</translation>
        </message>
        <message>
            <source>the simulation with seed {seed}</source>
            <translation>simuleringen med frö {seed}</translation>
        </message>
        <message>
            <source>the sole was not scanned under heel, ball and arch</source>
            <translation>fotsulan skannades inte under häl, trampdyna och fotvalv</translation>
        </message>
        <message>
            <source>the square of the board is more likely {likely_mm} mm than {square_mm:g} mm, so measure it and give its true side</source>
            <translation>brädets ruta är troligare {likely_mm} mm än {square_mm:g} mm, så mät den och ange dess verkliga sida</translation>
        </message>
        <message>
            <source>the surface is too coarse there: {places}</source>
            <translation>ytan är för grov där: {places}</translation>
        </message>
        <message>
            <source>the unit of its numbers</source>
            <translation>talens enhet</translation>
        </message>
        <message>
            <source>the {count} markers that were pointed at cannot be seen at these places from anywhere; check which marker is which</source>
            <translation>de {count} markörerna som pekades ut kan inte ses på dessa platser från någonstans; kontrollera vilken markör som är vilken</translation>
        </message>
        <message>
            <source>the {paint} spots of the object are not found ({reason}); show it whole and well lit, and check its list of points</source>
            <translation>föremålets {paint} fläckar hittas inte ({reason}); visa det helt och väl belyst, och kontrollera dess punktlista</translation>
        </message>
        <message>
            <source>thesis</source>
            <translation>avhandling</translation>
        </message>
        <message>
            <source>they are too few for a surface</source>
            <translation>de är för få för en yta</translation>
        </message>
        <message>
            <source>they lie on no surface</source>
            <translation>de ligger inte på någon yta</translation>
        </message>
        <message>
            <source>thickness</source>
            <translation>tjocklek</translation>
        </message>
        <message>
            <source>this design is of version {version}, and this program reads up to version {known}; install a newer Insole Studio.</source>
            <translation>designen är av version {version}, och detta program läser upp till version {known}; installera ett nyare Insole Studio.</translation>
        </message>
        <message>
            <source>this disk can only be read; choose another place</source>
            <translation>den här disken kan bara läsas; välj en annan plats</translation>
        </message>
        <message>
            <source>three-quarter</source>
            <translation>trekvarts</translation>
        </message>
        <message>
            <source>through {count:g} points, {width} × {length} mm, its middle at x = {x}, y = {y} mm</source>
            <translation>genom {count:g} punkter, {width} × {length} mm, dess mitt vid x = {x}, y = {y} mm</translation>
        </message>
        <message>
            <source>to the left</source>
            <translation>åt vänster</translation>
        </message>
        <message>
            <source>to the right</source>
            <translation>åt höger</translation>
        </message>
        <message>
            <source>to {height}</source>
            <translation>till {height}</translation>
        </message>
        <message>
            <source>toe crest</source>
            <translation>tåkam</translation>
        </message>
        <message>
            <source>toe filler</source>
            <translation>tåutfyllnad</translation>
        </message>
        <message>
            <source>toe zone</source>
            <translation>tåzon</translation>
        </message>
        <message>
            <source>toes</source>
            <translation>tår</translation>
        </message>
        <message>
            <source>top</source>
            <translation>uppifrån</translation>
        </message>
        <message>
            <source>total contact</source>
            <translation>helkontakt</translation>
        </message>
        <message>
            <source>transmetatarsal</source>
            <translation>transmetatarsal</translation>
        </message>
        <message>
            <source>transverse arch</source>
            <translation>främre fotvalv</translation>
        </message>
        <message>
            <source>turn</source>
            <translation>vridning</translation>
        </message>
        <message>
            <source>turned by {turn_deg:.0f}°, it looks like itself within {apart_mm:.1f} mm; move some markers by a few studs so that it is less regular</source>
            <translation>vriden {turn_deg:.0f}° liknar den sig själv inom {apart_mm:.1f} mm; flytta några markörer ett par knoppar så att den blir mindre regelbunden</translation>
        </message>
        <message>
            <source>turned, so that its toes point to y = 0</source>
            <translation>vänd, så att tårna pekar mot y = 0</translation>
        </message>
        <message>
            <source>twice in the file</source>
            <translation>två gånger i filen</translation>
        </message>
        <message>
            <source>two corrections have the id "{twice}"; give each its own.</source>
            <translation>två korrigeringar har id ”{twice}”; ge varje sitt eget.</translation>
        </message>
        <message>
            <source>two of its markers are only {apart_mm:.0f} mm apart; move them apart</source>
            <translation>två av dess markörer är bara {apart_mm:.0f} mm isär; flytta isär dem</translation>
        </message>
        <message>
            <source>two of its markers hide each other when it is seen from {turn_deg:.0f}° aside; move them apart across the face</source>
            <translation>två av dess markörer skymmer varandra när den ses {turn_deg:.0f}° från sidan; flytta isär dem över sidan</translation>
        </message>
        <message>
            <source>two raw numbers</source>
            <translation>två råvärden</translation>
        </message>
        <message>
            <source>ulcer</source>
            <translation>sår</translation>
        </message>
        <message>
            <source>uncertainty</source>
            <translation>mätosäkerhet</translation>
        </message>
        <message>
            <source>undercut</source>
            <translation>underskärning</translation>
        </message>
        <message>
            <source>underside</source>
            <translation>undersidan</translation>
        </message>
        <message>
            <source>unit</source>
            <translation>enhet</translation>
        </message>
        <message>
            <source>unlocked</source>
            <translation>upplåst</translation>
        </message>
        <message>
            <source>unmerged</source>
            <translation>åter isär</translation>
        </message>
        <message>
            <source>upper centre</source>
            <translation>uppe i mitten</translation>
        </message>
        <message>
            <source>upper left</source>
            <translation>uppe till vänster</translation>
        </message>
        <message>
            <source>upper right</source>
            <translation>uppe till höger</translation>
        </message>
        <message>
            <source>upwards</source>
            <translation>uppåt</translation>
        </message>
        <message>
            <source>valgus</source>
            <translation>valgus</translation>
        </message>
        <message>
            <source>variant {name}</source>
            <translation>variant {name}</translation>
        </message>
        <message>
            <source>varus</source>
            <translation>varus</translation>
        </message>
        <message>
            <source>version must be {known}, and is {version}.</source>
            <translation>version måste vara {known}, och är {version}.</translation>
        </message>
        <message>
            <source>version {number} of {day} by {author}</source>
            <translation>version {number} {day} av {author}</translation>
        </message>
        <message>
            <source>view {view}: {reason}</source>
            <translation>vyn {view}: {reason}</translation>
        </message>
        <message>
            <source>visit</source>
            <translation>besök</translation>
        </message>
        <message>
            <source>wart</source>
            <translation>vårta</translation>
        </message>
        <message>
            <source>watertight</source>
            <translation>vattentät</translation>
        </message>
        <message>
            <source>weight bearing</source>
            <translation>belastning</translation>
        </message>
        <message>
            <source>weight in kg</source>
            <translation>vikt i kg</translation>
        </message>
        <message>
            <source>what it holds does not follow the rules of the format</source>
            <translation>innehållet följer inte formatets regler</translation>
        </message>
        <message>
            <source>whether it is seen from above or below</source>
            <translation>om den är sedd uppifrån eller nerifrån</translation>
        </message>
        <message>
            <source>which foot it is</source>
            <translation>vilken fot det är</translation>
        </message>
        <message>
            <source>wide</source>
            <translation>bred</translation>
        </message>
        <message>
            <source>width</source>
            <translation>bredd</translation>
        </message>
        <message>
            <source>with a residual of {residual:.2f} mm</source>
            <translation>med en restavvikelse på {residual:.2f} mm</translation>
        </message>
        <message>
            <source>with each other and with the last one noted beside the files</source>
            <translation>med varandra och med den sista som noterats bredvid filerna</translation>
        </message>
        <message>
            <source>with each other, and not with the last one, which is not noted</source>
            <translation>med varandra, och inte med den sista, som inte är noterad</translation>
        </message>
        <message>
            <source>with walls and solid layers of {layer:g} mm</source>
            <translation>med väggar och täta lager om {layer:g} mm</translation>
        </message>
        <message>
            <source>worst: {markers}</source>
            <translation>sämst: {markers}</translation>
        </message>
        <message>
            <source>x = {x_mm:.0f} mm, y = {y_mm:.0f} mm</source>
            <translation>x = {x_mm:.0f} mm, y = {y_mm:.0f} mm</translation>
        </message>
        <message>
            <source>x {x:+.2f} %, y {y:+.2f} %, z {z:+.2f} %, skew {skew:+.2f}°</source>
            <translation>x {x:+.2f} %, y {y:+.2f} %, z {z:+.2f} %, skevhet {skew:+.2f}°</translation>
        </message>
        <message>
            <source>x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f} mm from the zero; its toes towards {direction}</source>
            <translation>x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f} mm från nollpunkten; tårna mot {direction}</translation>
        </message>
        <message>
            <source>x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f}, z 0 – {z_end:.1f} mm; {turn}</source>
            <translation>x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f}, z 0 – {z_end:.1f} mm; {turn}</translation>
        </message>
        <message>
            <source>yes</source>
            <translation>ja</translation>
        </message>
        <message>
            <source>you may not write there; choose another place or ask for permission</source>
            <translation>du får inte skriva där; välj en annan plats eller be om behörighet</translation>
        </message>
        <message>
            <source>{account} is the only administrator; make another one first.</source>
            <translation>{account} är den enda administratören; lägg först till en till.</translation>
        </message>
        <message>
            <source>{across} lateral of the axis, {from_heel} from the heel</source>
            <translation>{across} lateralt om axeln, {from_heel} från hälen</translation>
        </message>
        <message>
            <source>{across} medial of the axis, {from_heel} from the heel</source>
            <translation>{across} medialt om axeln, {from_heel} från hälen</translation>
        </message>
        <message>
            <source>{angle}°</source>
            <translation>{angle}°</translation>
        </message>
        <message>
            <source>{angle}° lateral</source>
            <translation>{angle}° lateralt</translation>
        </message>
        <message>
            <source>{angle}° medial</source>
            <translation>{angle}° medialt</translation>
        </message>
        <message>
            <source>{archive} holds the path "{file}", which leads out of the archive; do not use this file.</source>
            <translation>{archive} innehåller sökvägen ”{file}”, som leder ut ur arkivet; använd inte denna fil.</translation>
        </message>
        <message>
            <source>{archive} holds {file} twice, and nothing says which is right; pack it again.</source>
            <translation>{archive} innehåller {file} två gånger, och inget säger vilken som gäller; packa det på nytt.</translation>
        </message>
        <message>
            <source>{archive} is encrypted; unpack it with its password, and pack it again without.</source>
            <translation>{archive} är krypterat; packa upp det med lösenordet, och packa det på nytt utan.</translation>
        </message>
        <message>
            <source>{archive} is not a readable zip archive; copy it again from its source.</source>
            <translation>{archive} är inget läsbart zip-arkiv; kopiera det igen från källan.</translation>
        </message>
        <message>
            <source>{archive} is packed in an unusual way; unpack it, and pack it again as an ordinary zip archive.</source>
            <translation>{archive} är packat på ett ovanligt sätt; packa upp det, och packa det på nytt som ett vanligt zip-arkiv.</translation>
        </message>
        <message>
            <source>{archive} unpacks to more than {limit_gb} GB, far more than an order has; do not unpack it, and ask the clinic for another one.</source>
            <translation>{archive} packas upp till mer än {limit_gb} GB, långt mer än en beställning har; packa inte upp det, och be kliniken om ett nytt.</translation>
        </message>
        <message>
            <source>{archive} would unpack to {size_gb:.1f} GB in {files} files, far more than a session has; do not use this file.</source>
            <translation>{archive} skulle packas upp till {size_gb:.1f} GB i {files} filer, mycket mer än en session har; använd inte denna fil.</translation>
        </message>
        <message>
            <source>{area_mm2:.0f} mm² at {place} cannot be reached from above, nor from below with the part turned over; {limit:g} are allowed.</source>
            <translation>{area_mm2:.0f} mm² vid {place} kan inte nås uppifrån, och inte heller underifrån med detaljen vänd; {limit:g} är tillåtna.</translation>
        </message>
        <message>
            <source>{area_mm2:.0f} mm² cannot be reached from above at {place}; {limit:g} are allowed.</source>
            <translation>{area_mm2:.0f} mm² kan inte nås uppifrån vid {place}; {limit:g} är tillåtna.</translation>
        </message>
        <message>
            <source>{area_mm2:.0f} mm² cannot be reached from above, nor from below with the part turned over; {limit:g} are allowed.</source>
            <translation>{area_mm2:.0f} mm² kan inte nås uppifrån, och inte heller underifrån med detaljen vänd; {limit:g} är tillåtna.</translation>
        </message>
        <message>
            <source>{area_mm2:.0f} mm² cannot be reached from above; {limit:g} are allowed.</source>
            <translation>{area_mm2:.0f} mm² kan inte nås uppifrån; {limit:g} är tillåtna.</translation>
        </message>
        <message>
            <source>{author} at {station} has changed the {side} foot meanwhile; compare both versions and choose.</source>
            <translation>{author} vid {station} har under tiden ändrat {side} fot; jämför båda versionerna och välj.</translation>
        </message>
        <message>
            <source>{block}, {length:g} × {width:g} × {height:g} mm</source>
            <translation>{block}, {length:g} × {width:g} × {height:g} mm</translation>
        </message>
        <message>
            <source>{border} {depth}</source>
            <translation>{border} {depth}</translation>
        </message>
        <message>
            <source>{capture} has no reading in the middle; put a flat surface there.</source>
            <translation>{capture} har inget mätvärde i mitten; ställ en plan yta där.</translation>
        </message>
        <message>
            <source>{capture} is about {usual_mm:.0f} mm away, but {given_mm:.0f} mm was given, so measure again from the front of the sensor to the wall, with walls from 500 to 1000 mm</source>
            <translation>{capture} är omkring {usual_mm:.0f} mm bort, men {given_mm:.0f} mm angavs, så mät igen från sensorns framsida till väggen, med väggar från 500 till 1000 mm</translation>
        </message>
        <message>
            <source>{capture} is {width}×{height}, but a depth frame of this sensor must be {wanted_width}×{wanted_height}.</source>
            <translation>{capture} är {width}×{height}, men en djupbild från denna sensor måste vara {wanted_width}×{wanted_height}.</translation>
        </message>
        <message>
            <source>{capture} needs a reading at the image centre and its measured distance; measure it, or take the capture out.</source>
            <translation>{capture} behöver ett mätvärde i bildens mitt och sitt uppmätta avstånd; mät det, eller ta bort tagningen.</translation>
        </message>
        <message>
            <source>{capture} shows a wall {distance_mm:.0f} mm away, but the pattern was learnt from walls at {nearest_mm:.0f} to {farthest_mm:.0f} mm, and says nothing of others; check it by a wall between these.</source>
            <translation>{capture} visar en vägg {distance_mm:.0f} mm bort, men mönstret lärdes in från väggar på {nearest_mm:.0f} till {farthest_mm:.0f} mm och säger inget om andra; kontrollera det med en vägg däremellan.</translation>
        </message>
        <message>
            <source>{capture} shows {count} spheres of about {diameter_mm:g} mm, but the bar has 2; keep the space around them free and check the diameter.</source>
            <translation>{capture} visar {count} kulor på ungefär {diameter_mm:g} mm, men staven har 2; håll utrymmet kring dem fritt och kontrollera diametern.</translation>
        </message>
        <message>
            <source>{capture} was recorded by another kind of sensor than {serial}, a {model}; use captures of this sensor, each in a folder with its sensor.json.</source>
            <translation>{capture} spelades in med en annan sorts sensor än {serial}, en {model}; använd avbildningar från denna sensor, var och en i en mapp med dess sensor.json.</translation>
        </message>
        <message>
            <source>{capture} was recorded with sensor {owner}, not with {serial}; use the captures of one sensor.</source>
            <translation>{capture} spelades in med sensor {owner}, inte med {serial}; använd tagningar från en sensor.</translation>
        </message>
        <message>
            <source>{columns}×{rows} inner corners</source>
            <translation>{columns}×{rows} inre hörn</translation>
        </message>
        <message>
            <source>{columns}×{rows} inner corners, square {square_mm:g} mm</source>
            <translation>{columns}×{rows} inre hörn, ruta {square_mm:g} mm</translation>
        </message>
        <message>
            <source>{comparison} Restore to an empty database.</source>
            <translation>{comparison} Återställ till en tom databas.</translation>
        </message>
        <message>
            <source>{comparison} Restore to an empty place, or let this record be set aside.</source>
            <translation>{comparison} Återställ till en tom plats, eller låt den här journalen läggas åt sidan.</translation>
        </message>
        <message>
            <source>{correction}, {values}</source>
            <translation>{correction}, {values}</translation>
        </message>
        <message>
            <source>{correction}: {values}</source>
            <translation>{correction}: {values}</translation>
        </message>
        <message>
            <source>{correction}: {values} ({signed})</source>
            <translation>{correction}: {values} ({signed})</translation>
        </message>
        <message>
            <source>{count:g} places</source>
            <translation>{count:g} punkter</translation>
        </message>
        <message>
            <source>{count} added ({outcomes})</source>
            <translation>{count} tillagda ({outcomes})</translation>
        </message>
        <message>
            <source>{count} black dots were found on {name} and four are needed; pick the points instead.</source>
            <translation>{count} svarta prickar hittades på {name} och fyra behövs; välj punkterna i stället.</translation>
        </message>
        <message>
            <source>{count} captures, which may show or name the patient</source>
            <translation>{count} inspelningar, som kan visa eller nämna patienten</translation>
        </message>
        <message>
            <source>{count} corners, seen from the front</source>
            <translation>{count} hörn, sedda framifrån</translation>
        </message>
        <message>
            <source>{count} corners, turned {turn_deg:.0f}° {side}</source>
            <translation>{count} hörn, vridet {turn_deg:.0f}° {side}</translation>
        </message>
        <message>
            <source>{count} entries</source>
            <translation>{count} poster</translation>
        </message>
        <message>
            <source>{count} files</source>
            <translation>{count} filer</translation>
        </message>
        <message>
            <source>{count} files are missing or damaged in the record and are not in the backup; verify the record, and restore them from an earlier backup.</source>
            <translation>{count} filer saknas eller är skadade i journalen och finns inte i säkerhetskopian; kontrollera journalen och återställ dem från en tidigare säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} files of the record are missing, the first is {first}; restore them from a backup.</source>
            <translation>{count} av journalens filer saknas, den första är {first}; återställ dem från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} files of the settings were there already, and stay.</source>
            <translation>{count} filer med inställningar fanns redan och står kvar.</translation>
        </message>
        <message>
            <source>{count} files were changed since the record stored them, the first is {first}; restore them from a backup.</source>
            <translation>{count} filer har ändrats sedan journalen sparade dem, den första är {first}; återställ dem från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} files were lost before it was made, and are not in it.</source>
            <translation>{count} filer hade förlorats innan den gjordes och finns inte i den.</translation>
        </message>
        <message>
            <source>{count} job sheets</source>
            <translation>{count} arbetsblad</translation>
        </message>
        <message>
            <source>{count} lines</source>
            <translation>{count} rader</translation>
        </message>
        <message>
            <source>{count} of {taken} {kind} pictures were used; a corner is met within {rms_px:.2f} px.</source>
            <translation>{count} av {taken} bilder ({kind}) användes; ett hörn träffas inom {rms_px:.2f} px.</translation>
        </message>
        <message>
            <source>{count} patients were erased after the backup, and now again.</source>
            <translation>{count} patienter raderades efter säkerhetskopian och nu igen.</translation>
        </message>
        <message>
            <source>{count} photos, which show the patient</source>
            <translation>{count} foton, som visar patienten</translation>
        </message>
        <message>
            <source>{count} points far from all others were left out.</source>
            <translation>{count} punkter långt från alla andra har utelämnats.</translation>
        </message>
        <message>
            <source>{count} points stuck out of the surface as spikes and were drawn back.</source>
            <translation>{count} punkter stack ut ur ytan som taggar och har dragits tillbaka.</translation>
        </message>
        <message>
            <source>{count} points were left out that lie close beside others.</source>
            <translation>{count} punkter som ligger tätt intill andra utelämnades.</translation>
        </message>
        <message>
            <source>{count} rows</source>
            <translation>{count} rader</translation>
        </message>
        <message>
            <source>{count} rows of {kind} are gone that the audit log knows, the first is {first}; compare the record with a backup.</source>
            <translation>{count} rader av slaget {kind} som loggen känner till är borta, den första är {first}; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} rows of {kind} are in no line of the audit log, the first is {first}; compare the record with a backup.</source>
            <translation>{count} rader av slaget {kind} finns inte i någon rad i loggen, den första är {first}; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} rows of {kind} are not what the audit log says was stored, the first is {first}; compare them with a backup.</source>
            <translation>{count} rader av slaget {kind} är inte vad loggen säger att de var, den första är {first}; jämför dem med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} rows of {table} refer to something that is not there; restore the record from a backup.</source>
            <translation>{count} rader i {table} hänvisar till något som inte finns; återställ journalen från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} sensors were named, but at most {most} work.</source>
            <translation>{count} sensorer angavs, men högst {most} fungerar.</translation>
        </message>
        <message>
            <source>{count} signatures</source>
            <translation>{count} signaturer</translation>
        </message>
        <message>
            <source>{count} signed prescriptions are gone, the first is {first}; compare the record with a backup.</source>
            <translation>{count} signerade ordinationer är borta, den första är {first}; jämför journalen med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} signed prescriptions are not what was signed, the first is {first}; compare them with a backup.</source>
            <translation>{count} signerade ordinationer är inte vad som signerades, den första är {first}; jämför dem med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} signed prescriptions have a signature that the audit log does not know, the first is {first}; compare them with a backup.</source>
            <translation>{count} signerade ordinationer har en signatur som loggen inte känner till, den första är {first}; jämför dem med en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{count} small {scraps} beside the foot left out.</source>
            <translation>{count} små {scraps} bredvid foten utelämnades.</translation>
        </message>
        <message>
            <source>{count} zero bytes at the end of the file were left out.</source>
            <translation>{count} nollbyte i slutet av filen utelämnades.</translation>
        </message>
        <message>
            <source>{count} {outcome}</source>
            <translation>{count} {outcome}</translation>
        </message>
        <message>
            <source>{count} {things} were asked for, but 1 to {most} are possible.</source>
            <translation>{count} {things} begärdes, men 1 till {most} är möjliga.</translation>
        </message>
        <message>
            <source>{count} × {side}</source>
            <translation>{count} × {side}</translation>
        </message>
        <message>
            <source>{days:.0f} days old</source>
            <translation>{days:.0f} dagar gammal</translation>
        </message>
        <message>
            <source>{depth} is missing beside {infrared} in {folder}; a wall needs both, so restore it or take the picture out.</source>
            <translation>{depth} saknas bredvid {infrared} i {folder}; en vägg behöver båda, så återställ den eller ta bort bilden.</translation>
        </message>
        <message>
            <source>{depth} mm deep</source>
            <translation>djup {depth} mm</translation>
        </message>
        <message>
            <source>{deviation:.3f} mm at most</source>
            <translation>högst {deviation:.3f} mm</translation>
        </message>
        <message>
            <source>{difference}: within the error</source>
            <translation>{difference}: inom felet</translation>
        </message>
        <message>
            <source>{distance} ahead of the heads</source>
            <translation>{distance} framför metatarsalhuvudena</translation>
        </message>
        <message>
            <source>{distance} behind the heads</source>
            <translation>{distance} bakom metatarsalhuvudena</translation>
        </message>
        <message>
            <source>{dpi:g} dots per inch are none of a scanner; they must be {low:g} to {high:g}.</source>
            <translation>{dpi:g} punkter per tum har ingen skanner; det måste vara {low:g} till {high:g}.</translation>
        </message>
        <message>
            <source>{edge} {room:.0f} mm</source>
            <translation>{edge} {room:.0f} mm</translation>
        </message>
        <message>
            <source>{end_key}{where} is {end:g}, and must lie at least {least:g} beyond {start_key} ({start:g}), or the surface gets a step.</source>
            <translation>{end_key}{where} är {end:g}, och måste ligga minst {least:g} bortom {start_key} ({start:g}), annars får ytan ett steg.</translation>
        </message>
        <message>
            <source>{fault} ({reason})</source>
            <translation>{fault} ({reason})</translation>
        </message>
        <message>
            <source>{file} cannot be added under this name, which the order has already or which not every system takes; give it another name.</source>
            <translation>{file} kan inte läggas till under detta namn, som beställningen redan har eller som inte alla system tar emot; ge filen ett annat namn.</translation>
        </message>
        <message>
            <source>{file} does not say how many dots per inch it has; state them, or click two points whose distance is known.</source>
            <translation>{file} anger inte hur många punkter per tum den har; ange dem, eller klicka på två punkter vars avstånd är känt.</translation>
        </message>
        <message>
            <source>{file} does not say {what}; state it.</source>
            <translation>{file} anger inte {what}; ange det.</translation>
        </message>
        <message>
            <source>{file} has been changed since the order was written: quantities, materials, texts or names in it may be wrong; ask the clinic to send the order again.</source>
            <translation>{file} har ändrats sedan beställningen skrevs: antal, material, texter eller namn i den kan vara fel; be kliniken att skicka beställningen igen.</translation>
        </message>
        <message>
            <source>{file} has been changed since the order was written; ask the clinic to send the order again.</source>
            <translation>{file} har ändrats sedan beställningen skrevs; be kliniken att skicka beställningen igen.</translation>
        </message>
        <message>
            <source>{file} has settings and zones for a slicer, which a nest cannot keep; export the order for any machine to nest it.</source>
            <translation>{file} har inställningar och zoner för ett skivningsprogram, som en samläggning inte kan behålla; exportera beställningen för vilken maskin som helst.</translation>
        </message>
        <message>
            <source>{file} has {size} bytes, and {order} says {stated}; ask the clinic to send the order again.</source>
            <translation>{file} har {size} byte, och {order} anger {stated}; be kliniken att skicka beställningen igen.</translation>
        </message>
        <message>
            <source>{file} holds both sides, which lie in their own block; export the order without a block to nest it with others.</source>
            <translation>{file} innehåller båda sidorna, som ligger i ett eget block; exportera beställningen utan block för att lägga ut den med andra.</translation>
        </message>
        <message>
            <source>{file} holds what {real} was; ask the clinic to send the order again.</source>
            <translation>{file} innehåller det som {real} var; be kliniken att skicka beställningen igen.</translation>
        </message>
        <message>
            <source>{file} in {order} has been changed since the order was written; ask the clinic to send the order again.</source>
            <translation>{file} i {order} har ändrats sedan beställningen skrevs; be kliniken skicka beställningen på nytt.</translation>
        </message>
        <message>
            <source>{file} inside {archive} is damaged; copy the archive again from its source.</source>
            <translation>{file} i {archive} är skadad; kopiera arkivet igen från källan.</translation>
        </message>
        <message>
            <source>{file} is for the {side} foot, but holds what {real} was for the {real_side}: the sides are exchanged; do not make it, and ask the clinic to send the order again.</source>
            <translation>{file} gäller sidan {side} men innehåller det som {real} var för sidan {real_side}: sidorna är förväxlade; tillverka inte, och be kliniken att skicka beställningen igen.</translation>
        </message>
        <message>
            <source>{file} is given for the {side} foot, which its name or the order contradicts; correct one of them.</source>
            <translation>{file} anges för sidan {side}, men namnet eller beställningen säger något annat; rätta ett av dem.</translation>
        </message>
        <message>
            <source>{file} is larger than {limit_mb} MB, far more than such a file has; do not use the archive {archive}.</source>
            <translation>{file} är större än {limit_mb} MB, långt mer än en sådan fil har; använd inte arkivet {archive}.</translation>
        </message>
        <message>
            <source>{file} is larger than {limit_mb} MB, which no file of a session is; check what was put there.</source>
            <translation>{file} är större än {limit_mb} MB, vilket ingen fil i en session är; kontrollera vad som lades där.</translation>
        </message>
        <message>
            <source>{file} is missing, but manifest.json names the view {view}; restore it from the recording.</source>
            <translation>{file} saknas, men manifest.json anger vyn {view}; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{file} is missing; ask the clinic to send the order again.</source>
            <translation>{file} saknas; be kliniken att skicka beställningen igen.</translation>
        </message>
        <message>
            <source>{file} is named after the {named} foot, and {order} has it for the {side}; ask the clinic which is right.</source>
            <translation>{file} har namn efter sidan {named}, och {order} har den för sidan {side}; fråga kliniken vilket som stämmer.</translation>
        </message>
        <message>
            <source>{file} is not part of the order; leave it out, or ask the clinic about it.</source>
            <translation>{file} hör inte till beställningen; utelämna den eller fråga kliniken om den.</translation>
        </message>
        <message>
            <source>{file} is not valid JSON ({reason}); restore the file.</source>
            <translation>{file} är ingen giltig JSON ({reason}); återställ filen.</translation>
        </message>
        <message>
            <source>{file} is the map of a {side} foot, and the foot is a {foot_side} one; choose the other foot, or the other map.</source>
            <translation>{file} är en annan fots tryckbild ({side}) än den öppna foten ({foot_side}); välj den andra foten, eller den andra tryckbilden.</translation>
        </message>
        <message>
            <source>{file} leads out of the folder of the order; do not unpack the archive, and ask the clinic for another one.</source>
            <translation>{file} leder ut ur beställningens mapp; packa inte upp arkivet, och be kliniken om ett nytt.</translation>
        </message>
        <message>
            <source>{file} may only be read by you; ask for the right to write to it.</source>
            <translation>Du får bara läsa {file}; be om rätten att skriva till den.</translation>
        </message>
        <message>
            <source>{file} must hold one JSON object {{…}}; restore the file.</source>
            <translation>{file} måste innehålla ett JSON-objekt {{…}}; återställ filen.</translation>
        </message>
        <message>
            <source>{file} says {stated} for {term}, and {order} says {value}; ask the clinic which is right.</source>
            <translation>{file} anger {stated} för {term}, och {order} anger {value}; fråga kliniken vilket som stämmer.</translation>
        </message>
        <message>
            <source>{file}: the design is for a {side} foot and the foot is a {foot_side} one; restore the file from a backup.</source>
            <translation>{file}: designen är för en {side} fot och foten är en {foot_side}; återställ filen från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{file}: {key} {problem}.</source>
            <translation>{file}: {key} {problem}.</translation>
        </message>
        <message>
            <source>{file}: {place} {reason}</source>
            <translation>{file}: {place} {reason}</translation>
        </message>
        <message>
            <source>{file}: {place}design: {reason}</source>
            <translation>{file}: {place}design: {reason}</translation>
        </message>
        <message>
            <source>{file}: {reason}</source>
            <translation>{file}: {reason}</translation>
        </message>
        <message>
            <source>{finding} Change the design, or override the rule with a reason.</source>
            <translation>{finding} Ändra designen, eller gå förbi regeln med ett skäl.</translation>
        </message>
        <message>
            <source>{first} and {other} do not show the same foot: their soles do not fit each other.</source>
            <translation>{first} och {other} visar inte samma fot: deras fotsulor passar inte varandra.</translation>
        </message>
        <message>
            <source>{first} and {other} show two different feet, or one that was held quite differently: their soles lie {apart_mm:.1f} mm apart, and one is {longer_mm:.1f} mm longer; take the same foot of the same person, or the same cast, each time.</source>
            <translation>{first} och {other} visar två olika fötter, eller en som hölls helt annorlunda: deras fotsulor ligger {apart_mm:.1f} mm isär, och den ena är {longer_mm:.1f} mm längre; ta samma fot på samma person, eller samma avgjutning, varje gång.</translation>
        </message>
        <message>
            <source>{first} and {other} were captured in two different frames of markers; test each place on its own.</source>
            <translation>{first} och {other} avbildades i två olika markörramar; prova varje mätplats för sig.</translation>
        </message>
        <message>
            <source>{first} and {second}</source>
            <translation>{first} och {second}</translation>
        </message>
        <message>
            <source>{first} and {second}; the difference is within the error</source>
            <translation>{first} och {second}; skillnaden är inom felet</translation>
        </message>
        <message>
            <source>{first} is of a {side} foot, but {other} of a {others} one; a repeat test takes the same foot each time.</source>
            <translation>{first} är av en {side} fot, men {other} av en {others}; ett upprepningsprov görs med samma fot varje gång.</translation>
        </message>
        <message>
            <source>{first} was captured with the sensors {serials}, but {other} with {others}; prove each set of sensors on its own.</source>
            <translation>{first} spelades in med sensorerna {serials} men {other} med {others}; prova varje uppsättning sensorer för sig.</translation>
        </message>
        <message>
            <source>{first} was captured with the sensors {serials}, but {other} with {others}; test each place on its own.</source>
            <translation>{first} avbildades med sensorerna {serials}, men {other} med {others}; prova varje mätplats för sig.</translation>
        </message>
        <message>
            <source>{folder}</source>
            <translation>{folder}</translation>
        </message>
        <message>
            <source>{folder} cannot be read: {reason}; check its name.</source>
            <translation>{folder} kan inte läsas: {reason}; kontrollera namnet.</translation>
        </message>
        <message>
            <source>{folder} does not answer ({reason}); check that its disk or share is connected and that you may use it.</source>
            <translation>{folder} svarar inte ({reason}); kontrollera att dess disk eller nätverksmapp är ansluten och att du får använda den.</translation>
        </message>
        <message>
            <source>{folder} does not hold the files of this record; connect the disk or the share that holds them, then try again.</source>
            <translation>{folder} innehåller inte filerna till den här journalen; anslut den disk eller nätverksmapp som innehåller dem och försök igen.</translation>
        </message>
        <message>
            <source>{folder} does not keep what is written to it; use another disk for backups.</source>
            <translation>{folder} behåller inte det som skrivs dit; använd en annan disk för säkerhetskopior.</translation>
        </message>
        <message>
            <source>{folder} holds colour of {width}×{height}, which no Kinect v1 sends.</source>
            <translation>{folder} innehåller färg på {width}×{height}, vilket ingen Kinect v1 sänder.</translation>
        </message>
        <message>
            <source>{folder} holds colour pictures ({picture}) beside the depth images, as of a board for depth to colour; name the folder with the captures of flat, empty walls.</source>
            <translation>{folder} innehåller färgbilder ({picture}) bredvid djupbilderna, som av ett bräde för djup till färg; ange mappen med bilderna av plana, tomma väggar.</translation>
        </message>
        <message>
            <source>{folder} holds more than {most} cases; choose the folders in it one by one.</source>
            <translation>{folder} innehåller mer än {most} fall; välj mapparna i den en i taget.</translation>
        </message>
        <message>
            <source>{folder} holds no PNG images; name the folder with the wall captures.</source>
            <translation>{folder} innehåller inga PNG-bilder; ange mappen med tagningarna av väggen.</translation>
        </message>
        <message>
            <source>{folder} holds no backup; choose the folder that has {name} in it.</source>
            <translation>{folder} innehåller ingen säkerhetskopia; välj den mapp som har {name} i sig.</translation>
        </message>
        <message>
            <source>{folder} holds no case files ({suffix}); choose another folder.</source>
            <translation>{folder} innehåller inga fallfiler ({suffix}); välj en annan mapp.</translation>
        </message>
        <message>
            <source>{folder} holds no finished backup, since the first one was broken off; back the record up to it again, or choose another folder.</source>
            <translation>{folder} har ingen färdig säkerhetskopia, eftersom den första avbröts; säkerhetskopiera journalen dit igen, eller välj en annan mapp.</translation>
        </message>
        <message>
            <source>{folder} holds no infrared_00.png; name the folder with the infrared pictures of walls.</source>
            <translation>{folder} innehåller ingen infrared_00.png; ange mappen med de infraröda bilderna av väggar.</translation>
        </message>
        <message>
            <source>{folder} holds no pictures named {kind}…; name the folder with the {words}.</source>
            <translation>{folder} innehåller inga bilder med namnet {kind}…; ange mappen med {words}.</translation>
        </message>
        <message>
            <source>{folder} holds no snapshot {number}; it has: {numbers}.</source>
            <translation>{folder} innehåller ingen säkerhetskopia {number}; där finns: {numbers}.</translation>
        </message>
        <message>
            <source>{folder} holds no unfinished capture; it was used or discarded, or never was one.</source>
            <translation>{folder} innehåller ingen oavslutad avbildning; den har använts eller kasserats, eller var aldrig någon.</translation>
        </message>
        <message>
            <source>{folder} holds no {kind}_000.png, but a view has at least one; restore it from the recording.</source>
            <translation>{folder} innehåller ingen {kind}_000.png, men en vy har minst en; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{folder} holds no {missing} pictures, but a view needs at least one; record again with {missing}.</source>
            <translation>{folder} innehåller inga bilder av typen {missing}, men en vy behöver minst en; spela in igen med {missing}.</translation>
        </message>
        <message>
            <source>{folder} holds no {what}; name the folder with the pictures of the board.</source>
            <translation>{folder} innehåller inga {what}; ange mappen med bilderna av brädet.</translation>
        </message>
        <message>
            <source>{folder} holds the backups of another record, or of this one under another passphrase; choose another folder.</source>
            <translation>{folder} innehåller säkerhetskopior av en annan journal, eller av den här med en annan lösenfras; välj en annan mapp.</translation>
        </message>
        <message>
            <source>{folder} holds the calibration of sensor {owner}; calibrate sensor {serial} again.</source>
            <translation>{folder} innehåller kalibreringen av sensor {owner}; kalibrera om sensor {serial}.</translation>
        </message>
        <message>
            <source>{folder} holds {count} {kind} frames, but a view has at most {most}; take the others out.</source>
            <translation>{folder} innehåller {count} bilder {kind}, men en vy har högst {most}; ta bort de övriga.</translation>
        </message>
        <message>
            <source>{folder} is in use by another window or command; finish or close that one first.</source>
            <translation>{folder} används av ett annat fönster eller kommando; avsluta eller stäng det först.</translation>
        </message>
        <message>
            <source>{folder} was not left by a capture; choose the folder it named.</source>
            <translation>{folder} lämnades inte av en avbildning; välj mappen som den angav.</translation>
        </message>
        <message>
            <source>{foot} if it is in {unit}</source>
            <translation>{foot} om den är i {unit}</translation>
        </message>
        <message>
            <source>{frame} is missing, but later frames are there; restore it or renumber.</source>
            <translation>{frame} saknas, men senare bilder finns; återställ den eller numrera om.</translation>
        </message>
        <message>
            <source>{free:.1f} GB free</source>
            <translation>{free:.1f} GB ledigt</translation>
        </message>
        <message>
            <source>{from_heel:.0f} mm from the heel on the lateral side</source>
            <translation>{from_heel:.0f} mm från hälen på den laterala sidan</translation>
        </message>
        <message>
            <source>{from_heel:.0f} mm from the heel on the medial side</source>
            <translation>{from_heel:.0f} mm från hälen på den mediala sidan</translation>
        </message>
        <message>
            <source>{given} distances are given, but {folder} holds {count} captures; give one distance for each, in the order of their names.</source>
            <translation>{given} avstånd är angivna, men {folder} innehåller {count} tagningar; ange ett avstånd för var och en, i namnens ordning.</translation>
        </message>
        <message>
            <source>{heights} mm</source>
            <translation>{heights} mm</translation>
        </message>
        <message>
            <source>{heights} mm over the foot</source>
            <translation>{heights} mm över foten</translation>
        </message>
        <message>
            <source>{heights} mm over the toes</source>
            <translation>{heights} mm över tårna</translation>
        </message>
        <message>
            <source>{height} ({length} × {width})</source>
            <translation>{height} ({length} × {width})</translation>
        </message>
        <message>
            <source>{height} mm high</source>
            <translation>{height} mm hög</translation>
        </message>
        <message>
            <source>{hours} h {minutes} min</source>
            <translation>{hours} h {minutes} min</translation>
        </message>
        <message>
            <source>{key} of form has {count} stations, and must have {least} to {most}; add or remove some.</source>
            <translation>{key} i form har {count} stationer och måste ha {least} till {most}; lägg till eller ta bort några.</translation>
        </message>
        <message>
            <source>{key} of form must increase; put its stations in order.</source>
            <translation>{key} i form måste stiga; ordna stationerna.</translation>
        </message>
        <message>
            <source>{key}{where} has {count} places, and must have {least} to {most}; draw it again.</source>
            <translation>{key}{where} har {count} platser, och måste ha {least} till {most}; rita den igen.</translation>
        </message>
        <message>
            <source>{key}{where} is "{value}", and must be {allowed}.</source>
            <translation>{key}{where} är ”{value}”, och måste vara {allowed}.</translation>
        </message>
        <message>
            <source>{key}{where} is {value:g}, and must be {range}; put in a value of that range.</source>
            <translation>{key}{where} är {value:g}, och måste vara {range}; ange ett värde i det området.</translation>
        </message>
        <message>
            <source>{kind} is no kind of a capture; use session or mesh.</source>
            <translation>{kind} är inget slags avbildning; använd session eller mesh.</translation>
        </message>
        <message>
            <source>{kind}; report it if it does not go away.</source>
            <translation>{kind}; rapportera det om det inte går över.</translation>
        </message>
        <message>
            <source>{least:g} to {most:g}</source>
            <translation>{least:g} till {most:g}</translation>
        </message>
        <message>
            <source>{least:g} to {most:g} {unit}</source>
            <translation>{least:g} till {most:g} {unit}</translation>
        </message>
        <message>
            <source>{length:.1f} × {width:.1f} × {height:.1f} mm</source>
            <translation>{length:.1f} × {width:.1f} × {height:.1f} mm</translation>
        </message>
        <message>
            <source>{length_mm:.0f} mm (no foot)</source>
            <translation>{length_mm:.0f} mm (ingen fot)</translation>
        </message>
        <message>
            <source>{length_mm:.0f} mm long</source>
            <translation>{length_mm:.0f} mm lång</translation>
        </message>
        <message>
            <source>{limit} triangles are too few for this solid: {count} deviate by {deviation_mm:.3f} mm, and {allowed_mm:g} mm are allowed; allow more triangles or more deviation.</source>
            <translation>{limit} trianglar är för få för denna kropp: {count} avviker {deviation_mm:.3f} mm, och {allowed_mm:g} mm är tillåtet; tillåt fler trianglar eller större avvikelse.</translation>
        </message>
        <message>
            <source>{line}: {across} = {at:.1f} mm, along {axis}</source>
            <translation>{line}: {across} = {at:.1f} mm, längs {axis}</translation>
        </message>
        <message>
            <source>{list}[{number}]</source>
            <translation>{list}[{number}]</translation>
        </message>
        <message>
            <source>{low:g} to {high:g} kPa</source>
            <translation>{low:g} till {high:g} kPa</translation>
        </message>
        <message>
            <source>{machine} travels {there:g} mm along {axis}, and the block needs {need:g} mm; take a smaller block.</source>
            <translation>{machine} går {there:g} mm längs {axis}, och blocket behöver {need:g} mm; ta ett mindre block.</translation>
        </message>
        <message>
            <source>{maker}, {maker address}, states: this device is intended for the exclusive use of the patient identified above. It was made to the prescription set out here, which {prescriber} made out. It conforms to the general safety and performance requirements of Annex I; requirements that are not fully met, if any, are listed with the reasons: none. This statement and the documentation of the device are kept available to the competent authorities for at least ten years after the device was placed on the market.</source>
            <translation>{maker}, {maker address}, försäkrar: denna produkt är uteslutande avsedd för den patient som identifieras ovan. Den har tillverkats efter den ordination som återges här och som {prescriber} har utfärdat. Den uppfyller de allmänna kraven på säkerhet och prestanda i bilaga I; krav som eventuellt inte är helt uppfyllda anges med skälen: inga. Denna försäkran och produktens dokumentation hålls tillgängliga för de behöriga myndigheterna i minst tio år efter att produkten släpptes ut på marknaden.</translation>
        </message>
        <message>
            <source>{markers} excluded</source>
            <translation>{markers} uteslutna</translation>
        </message>
        <message>
            <source>{markers} pointed at</source>
            <translation>{markers} utpekade</translation>
        </message>
        <message>
            <source>{minutes} min</source>
            <translation>{minutes} min</translation>
        </message>
        <message>
            <source>{names} points are named, but {true_points} true and {measured_points} measured positions are given; give each point's both positions.</source>
            <translation>{names} punkter har namn, men {true_points} sanna och {measured_points} uppmätta lägen är angivna; ange båda lägena för varje punkt.</translation>
        </message>
        <message>
            <source>{name} (mirrored)</source>
            <translation>{name} (spegelvänd)</translation>
        </message>
        <message>
            <source>{name} as it was drawn, its print not measured</source>
            <translation>{name} som den är ritad, utskriften inte mätt</translation>
        </message>
        <message>
            <source>{name} as it was printed ({off})</source>
            <translation>{name} som den skrevs ut ({off})</translation>
        </message>
        <message>
            <source>{name} cannot be decoded; restore it from the recording.</source>
            <translation>{name} kan inte avkodas; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{name} cannot be read ({reason}); check the disk and the permissions.</source>
            <translation>{name} kan inte läsas ({reason}); kontrollera disken och behörigheterna.</translation>
        </message>
        <message>
            <source>{name} corrects another kind of sensor than this one; calibrate this sensor, or put in its own correction.</source>
            <translation>{name} rättar en annan sorts sensor än den här; kalibrera den här sensorn, eller lägg in dess egen rättning.</translation>
        </message>
        <message>
            <source>{name} does not look like a last: no sole of a shoe is found on it; hand in the last as a surface with its sole.</source>
            <translation>{name} ser inte ut som en läst: ingen skosula hittas på den; lämna in lästen som en yta med sin sula.</translation>
        </message>
        <message>
            <source>{name} has no colours, so no dots can be found; pick the points instead.</source>
            <translation>{name} har inga färger, så inga prickar kan hittas; välj punkterna i stället.</translation>
        </message>
        <message>
            <source>{name} has no flat surface left to evaluate; capture a flat wall.</source>
            <translation>{name} har ingen plan yta kvar att utvärdera; ta en plan vägg.</translation>
        </message>
        <message>
            <source>{name} has signed this version already; make a new one to change it.</source>
            <translation>{name} har redan signerat den här versionen; gör en ny för att ändra den.</translation>
        </message>
        <message>
            <source>{name} holds no depth frames; capture it again.</source>
            <translation>{name} innehåller inga djupbilder; ta om den.</translation>
        </message>
        <message>
            <source>{name} holds no readable array "offset"; calibrate the sensor again.</source>
            <translation>{name} innehåller inget läsbart fält ”offset”; kalibrera sensorn igen.</translation>
        </message>
        <message>
            <source>{name} holds no readable array "record"; calibrate the sensor again.</source>
            <translation>{name} innehåller ingen läsbar matris ”record”; kalibrera sensorn igen.</translation>
        </message>
        <message>
            <source>{name} holds no readable infrared reference pattern; make it again by calibrate infrared.</source>
            <translation>{name} innehåller inget läsbart infrarött punktmönster; gör det på nytt med calibrate infrared.</translation>
        </message>
        <message>
            <source>{name} holds no reading at all; move the sensor 500 to 3000 mm from the wall and capture it again.</source>
            <translation>{name} innehåller inga mätvärden alls; ställ sensorn 500 till 3000 mm från väggen och ta om den.</translation>
        </message>
        <message>
            <source>{name} holds two feet, and there is another scan beside it; choose the feet that are meant.</source>
            <translation>{name} innehåller två fötter, och bredvid finns ytterligare en skanning; välj de fötter som avses.</translation>
        </message>
        <message>
            <source>{name} is a last for the {last_side} foot, and the insole is for the {side} one; choose the other last of the pair.</source>
            <translation>{name} är en läst för {last_side} fot, och inlägget är för {side}; välj parets andra läst.</translation>
        </message>
        <message>
            <source>{name} is damaged; restore it from a backup.</source>
            <translation>{name} är skadad; återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{name} is missing, but sensor.json names it as disparity_correction; restore it from the recording.</source>
            <translation>{name} saknas, men sensor.json anger den som disparity_correction; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{name} is missing, but sensor.json names it as infrared_reference; restore it from the recording.</source>
            <translation>{name} saknas, men sensor.json anger den som infrared_reference; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{name} is named as a {side} foot, but is opened as a {said} one; say which foot it is.</source>
            <translation>{name} heter som en {side} fot, men öppnas som en {said}; säg vilken fot det är.</translation>
        </message>
        <message>
            <source>{name} is named as a {side} foot, but looks like a {told} one; say which foot it is.</source>
            <translation>{name} heter som en {side} fot men ser ut som en {told}; ange vilken fot det är.</translation>
        </message>
        <message>
            <source>{name} is no machine file: these end in .json. Name one, or a machine: {known}.</source>
            <translation>{name} är ingen maskinfil: sådana slutar på .json. Ange en, eller en maskin: {known}.</translation>
        </message>
        <message>
            <source>{name} is no number a design can hold; put in a usual one.</source>
            <translation>{name} är inget tal som en design kan ha; ange ett vanligt.</translation>
        </message>
        <message>
            <source>{name} is not a PNG image; restore it from the recording.</source>
            <translation>{name} är ingen PNG-bild; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{name} is of the other foot, so that it is mirrored.</source>
            <translation>{name} hör till den andra foten, och speglas därför.</translation>
        </message>
        <message>
            <source>{name} is of version {version}, which is newer than this program (it reads up to {newest}); install a newer Insole Studio.</source>
            <translation>{name} är av version {version}, som är nyare än detta program (det läser upp till {newest}); installera ett nyare Insole Studio.</translation>
        </message>
        <message>
            <source>{name} is the pattern of sensor {found}, but the view is of sensor {serial}; put in the pattern of that sensor.</source>
            <translation>{name} är mönstret av sensor {found}, men vyn är av sensor {serial}; lägg in den sensorns mönster.</translation>
        </message>
        <message>
            <source>{name} is truncated or damaged; restore it from the recording.</source>
            <translation>{name} är avkortad eller skadad; återställ den från inspelningen.</translation>
        </message>
        <message>
            <source>{name} is {found}, but must be {expected}.</source>
            <translation>{name} är {found}, men måste vara {expected}.</translation>
        </message>
        <message>
            <source>{name} is {value} (usual: {low} to {high})</source>
            <translation>{name} är {value} (vanligt: {low} till {high})</translation>
        </message>
        <message>
            <source>{name} stands {away_mm:.1f} mm and {turn_deg:.1f}° from its place among the markers; check that the markers are those of its own stand and lie flat on its posts.</source>
            <translation>{name} står {away_mm:.1f} mm och {turn_deg:.1f}° från sin plats bland markörerna; kontrollera att markörerna är dess eget ställs och ligger plant på dess stolpar.</translation>
        </message>
        <message>
            <source>{name} {value}</source>
            <translation>{name} {value}</translation>
        </message>
        <message>
            <source>{name}, trimmed to it</source>
            <translation>{name}, efter vilken det skärs</translation>
        </message>
        <message>
            <source>{name}: "{key}" must hold {what}; calibrate the sensor again.</source>
            <translation>{name}: ”{key}” måste innehålla {what}; kalibrera sensorn igen.</translation>
        </message>
        <message>
            <source>{name}: the array "{key}" must hold {height}×{width} finite numbers; calibrate the sensor again.</source>
            <translation>{name}: fältet ”{key}” måste innehålla {height}×{width} ändliga tal; kalibrera sensorn igen.</translation>
        </message>
        <message>
            <source>{name}: the array {array} is damaged, or of a kind that does not belong there; restore the file.</source>
            <translation>{name}: matrisen {array} är skadad, eller av ett slag som inte hör hemma där; återställ filen.</translation>
        </message>
        <message>
            <source>{name}: {warning}</source>
            <translation>{name}: {warning}</translation>
        </message>
        <message>
            <source>{number:.12g}</source>
            <translation>{number:.12g}</translation>
        </message>
        <message>
            <source>{number} mm</source>
            <translation>{number} mm</translation>
        </message>
        <message>
            <source>{number}: {mark}, {side}</source>
            <translation>{number}: {mark}, {side}</translation>
        </message>
        <message>
            <source>{offset}: {place}</source>
            <translation>{offset}: {place}</translation>
        </message>
        <message>
            <source>{offset}: {place}, and from there x {x:g} mm, y {y:g} mm</source>
            <translation>{offset}: {place}, och därifrån x {x:g} mm, y {y:g} mm</translation>
        </message>
        <message>
            <source>{order} is not as it was written: {problems}</source>
            <translation>{order} är inte som den skrevs: {problems}</translation>
        </message>
        <message>
            <source>{order} {side}</source>
            <translation>{order} {side}</translation>
        </message>
        <message>
            <source>{other} is a copy of {one}; take the foot off, put it back, and capture it anew.</source>
            <translation>{other} är en kopia av {one}; ta bort foten, lägg tillbaka den och avbilda den på nytt.</translation>
        </message>
        <message>
            <source>{paper} is a paper, which is written as .pdf; change its suffix.</source>
            <translation>{paper} är ett papper, som skrivs som .pdf; ändra filändelsen.</translation>
        </message>
        <message>
            <source>{part_0} and {part_1}</source>
            <translation>{part_0} och {part_1}</translation>
        </message>
        <message>
            <source>{part_0} and {part_1} and {part_2}</source>
            <translation>{part_0} och {part_1} och {part_2}</translation>
        </message>
        <message>
            <source>{part_0} and {part_1} and {part_2} and {part_3}</source>
            <translation>{part_0} och {part_1} och {part_2} och {part_3}</translation>
        </message>
        <message>
            <source>{part_0} or {part_1}</source>
            <translation>{part_0} eller {part_1}</translation>
        </message>
        <message>
            <source>{part_0} or {part_1} or {part_2}</source>
            <translation>{part_0} eller {part_1} eller {part_2}</translation>
        </message>
        <message>
            <source>{part_0} with {part_1}</source>
            <translation>{part_0} med {part_1}</translation>
        </message>
        <message>
            <source>{part_0} with {part_1} with {part_2}</source>
            <translation>{part_0} med {part_1} med {part_2}</translation>
        </message>
        <message>
            <source>{part}, {value}</source>
            <translation>{part}, {value}</translation>
        </message>
        <message>
            <source>{path} are outlines, which are written as .dxf; change its suffix.</source>
            <translation>{path} är konturer, som skrivs som .dxf; ändra filändelsen.</translation>
        </message>
        <message>
            <source>{path} cannot be opened: no program for it is installed; open it from the file manager.</source>
            <translation>{path} kan inte öppnas: det finns inget program för den; öppna den från filhanteraren.</translation>
        </message>
        <message>
            <source>{path} cannot be read ({reason}); check that it is there and that you may read it.</source>
            <translation>{path} kan inte läsas ({reason}); kontrollera att den finns och att du får läsa den.</translation>
        </message>
        <message>
            <source>{path} cannot be read after line {line}: a quotation mark is not closed, or a text is too long; correct it, or export it again.</source>
            <translation>{path} kan inte läsas efter rad {line}: ett citattecken är inte avslutat eller en text är för lång; rätta det eller exportera filen igen.</translation>
        </message>
        <message>
            <source>{path} cannot be read: {reason}; check the name of the file.</source>
            <translation>{path} kan inte läsas: {reason}; kontrollera filens namn.</translation>
        </message>
        <message>
            <source>{path} cannot be read: {reason}; check the name of the folder.</source>
            <translation>{path} kan inte läsas: {reason}; kontrollera mappens namn.</translation>
        </message>
        <message>
            <source>{path} cannot be read: {reason}; export it again.</source>
            <translation>{path} kan inte läsas: {reason}; exportera den igen.</translation>
        </message>
        <message>
            <source>{path} cannot be removed ({reason}); check that you may write there.</source>
            <translation>{path} kan inte tas bort ({reason}); kontrollera att du får skriva där.</translation>
        </message>
        <message>
            <source>{path} cannot be written: the disk is full; free some space and try again.</source>
            <translation>{path} kan inte skrivas: disken är full; frigör utrymme och försök igen.</translation>
        </message>
        <message>
            <source>{path} cannot be written: this place takes no files; choose another place.</source>
            <translation>{path} kan inte skrivas: platsen tar inte emot filer; välj en annan plats.</translation>
        </message>
        <message>
            <source>{path} cannot be written: {reason}.</source>
            <translation>{path} kan inte skrivas: {reason}.</translation>
        </message>
        <message>
            <source>{path} cannot be written: {reason}; choose another place.</source>
            <translation>{path} kan inte skrivas: {reason}; välj en annan plats.</translation>
        </message>
        <message>
            <source>{path} cannot be written; choose another place.</source>
            <translation>{path} kan inte skrivas; välj en annan plats.</translation>
        </message>
        <message>
            <source>{path} declares entities or a type of its document, which no scan does; do not use it.</source>
            <translation>{path} deklarerar entiteter eller en dokumenttyp, vilket ingen skanning gör; använd den inte.</translation>
        </message>
        <message>
            <source>{path} declares something twice or without a number in its header; export it again.</source>
            <translation>{path} anger något två gånger eller utan antal i sitt huvud; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} declares {declared} points and triangles, but it does not hold exactly as many; it is damaged or cut off, so export it again.</source>
            <translation>{path} anger {declared} punkter och trianglar, men innehåller inte precis så många; den är skadad eller avskuren, så exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} declares {declared} triangles and holds {held}; it is damaged or cut off, so export it again.</source>
            <translation>{path} anger {declared} trianglar och innehåller {held}; den är skadad eller avskuren, så exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} does not end in "endsolid", so it is cut off; export it again.</source>
            <translation>{path} slutar inte med ”endsolid”, så den är avskuren; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} does not exist; check the name of the file.</source>
            <translation>{path} finns inte; kontrollera filens namn.</translation>
        </message>
        <message>
            <source>{path} does not exist; check the name.</source>
            <translation>{path} finns inte; kontrollera namnet.</translation>
        </message>
        <message>
            <source>{path} does not say how many sensels there are and how large they are; export it again.</source>
            <translation>{path} anger inte hur många sensorer det finns och hur stora de är; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} does not say the serial numbers of its sensors, so that a test of them would hold for any; capture with sensors that tell theirs.</source>
            <translation>{path} anger inte sensorernas serienummer, så att provet skulle gälla för vilka som helst; avbilda med sensorer som anger sina.</translation>
        </message>
        <message>
            <source>{path} does not tell its character set, and names read differently in each; choose it (--encoding), or save the table again as CSV UTF-8: {readings}.</source>
            <translation>{path} säger inte sin teckenuppsättning, och namn läses olika i varje; välj den (--encoding), eller spara tabellen igen som CSV UTF-8: {readings}.</translation>
        </message>
        <message>
            <source>{path} has a triangle with the corner 0, but an OBJ counts from 1; export it again.</source>
            <translation>{path} har en triangel med hörnet 0, men en OBJ räknar från 1; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} has lost its {file}; restore the file from a backup.</source>
            <translation>{path} har förlorat {file}; återställ filen från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{path} has more than {most} million pixels; scan it with fewer dots per inch.</source>
            <translation>{path} har mer än {most} miljoner bildpunkter; skanna med färre punkter per tum.</translation>
        </message>
        <message>
            <source>{path} has more than {most} million pixels; take the photo with fewer, or save it smaller.</source>
            <translation>{path} har mer än {most} miljoner bildpunkter; ta fotot med färre eller spara det mindre.</translation>
        </message>
        <message>
            <source>{path} has more than {most} rows; divide it.</source>
            <translation>{path} har mer än {most} rader; dela upp den.</translation>
        </message>
        <message>
            <source>{path} has no header of a PLY; export it again.</source>
            <translation>{path} saknar en PLY-fils huvud; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} has triangles of {area_m2:.0f} m² together, far more than a leg and a foot; their corners are mixed up, so export it again.</source>
            <translation>{path} har trianglar på sammanlagt {area_m2:.0f} m², långt mer än ett ben och en fot; deras hörn är förväxlade, så exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} holds coordinates that are not numbers; it is damaged, so export it again.</source>
            <translation>{path} innehåller koordinater som inte är tal; den är skadad, så exportera den igen.</translation>
        </message>
        <message>
            <source>{path} holds more sensors or frames than a plate has; export one step only.</source>
            <translation>{path} innehåller fler sensorer eller bilder än en tryckplatta har; exportera bara ett steg.</translation>
        </message>
        <message>
            <source>{path} holds more than {count} files; choose the folder of one visit.</source>
            <translation>{path} innehåller mer än {count} filer; välj mappen för ett besök.</translation>
        </message>
        <message>
            <source>{path} holds no frame of pressures; export it again.</source>
            <translation>{path} innehåller ingen tryckbild; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} holds no manifest.json, so it is not a recorded session; choose the folder or zip archive of a session.</source>
            <translation>{path} innehåller ingen manifest.json, så det är ingen inspelad session; välj en sessions mapp eller zip-arkiv.</translation>
        </message>
        <message>
            <source>{path} holds no prescription yet; choose a case with a design.</source>
            <translation>{path} innehåller ingen ordination än; välj ett fall med en design.</translation>
        </message>
        <message>
            <source>{path} holds no pressure above 0; export it again.</source>
            <translation>{path} innehåller inget tryck över 0; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} holds no raw 11-bit depth of 640×480; record it with depth format 11 bit.</source>
            <translation>{path} innehåller inget rått 11-bitars djup på 640×480; spela in med djupformatet 11 bitar.</translation>
        </message>
        <message>
            <source>{path} holds no scan; hand in a file of one of the formats {suffixes}, or a folder or zip archive with the scans of one person.</source>
            <translation>{path} innehåller ingen skanning; ange en fil i något av formaten {suffixes}, eller en mapp eller ett zip-arkiv med en persons skanningar.</translation>
        </message>
        <message>
            <source>{path} holds no sensor; export it again.</source>
            <translation>{path} innehåller ingen sensor; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} holds no surface that can be read, as if it were cut off or held points in a few places only; export it again as a triangle mesh.</source>
            <translation>{path} innehåller ingen läsbar yta, som om den vore avkortad eller bara hade punkter på några få ställen; exportera den igen som triangelnät.</translation>
        </message>
        <message>
            <source>{path} holds no table of pressures: at least {rows} rows of {columns} numbers; choose the export of a pressure plate.</source>
            <translation>{path} innehåller ingen tabell med tryck: minst {rows} rader med {columns} tal; välj exporten från en tryckplatta.</translation>
        </message>
        <message>
            <source>{path} holds no {file}, so it is no case; choose an .insole file.</source>
            <translation>{path} innehåller ingen {file}, så det är inget fall; välj en .insole-fil.</translation>
        </message>
        <message>
            <source>{path} holds no {file}, so that it is no order; choose the folder or zip archive of an order.</source>
            <translation>{path} har ingen {file} och är därför ingen beställning; välj en beställnings mapp eller zip-arkiv.</translation>
        </message>
        <message>
            <source>{path} holds only triangles without area; export it again.</source>
            <translation>{path} innehåller bara trianglar utan area; exportera den igen.</translation>
        </message>
        <message>
            <source>{path} holds pressures below 0; export it again, calibrated.</source>
            <translation>{path} innehåller tryck under 0; exportera den på nytt, kalibrerad.</translation>
        </message>
        <message>
            <source>{path} holds pressures that no device measures; export it again.</source>
            <translation>{path} innehåller tryck som ingen utrustning mäter; exportera det igen.</translation>
        </message>
        <message>
            <source>{path} holds something else than its name says ({format}, not {suffix}); choose another file, or give it its right name.</source>
            <translation>{path} innehåller något annat än namnet säger ({format}, inte {suffix}); välj en annan fil eller ge den dess rätta namn.</translation>
        </message>
        <message>
            <source>{path} holds something else than its name says: {kind}. Choose another file.</source>
            <translation>{path} innehåller något annat än namnet säger: {kind}. Välj en annan fil.</translation>
        </message>
        <message>
            <source>{path} holds two scans of the {side} foot by their names ({first}, {second}); open the one that is meant.</source>
            <translation>{path} innehåller enligt namnen två skanningar av {side} fot ({first}, {second}); öppna den som avses.</translation>
        </message>
        <message>
            <source>{path} holds {count_a} points of a and {count_b} of b; pick each point on both.</source>
            <translation>{path} innehåller {count_a} punkter av a och {count_b} av b; välj varje punkt på båda.</translation>
        </message>
        <message>
            <source>{path} holds {count} files, far more than an order has; choose another place.</source>
            <translation>{path} har {count} filer, långt fler än en beställning har; välj en annan plats.</translation>
        </message>
        <message>
            <source>{path} holds {count} scans ({names} …), and one foot or both are expected; open the one that is meant.</source>
            <translation>{path} innehåller {count} skanningar ({names} …), men en fot eller båda väntas; öppna den som avses.</translation>
        </message>
        <message>
            <source>{path} is a link to {target}, which is not replaced through it; give the result another name, or name {target} itself.</source>
            <translation>{path} är en länk till {target}, som inte ersätts genom den; ge resultatet ett annat namn, eller ange {target} själv.</translation>
        </message>
        <message>
            <source>{path} is a mesh, which does not say which foot it is; add --side.</source>
            <translation>{path} är en ytmodell, som inte säger vilken fot det är; ange --side.</translation>
        </message>
        <message>
            <source>{path} is a pointer of Git LFS, three lines that stand for the file; fetch the file itself (git lfs pull), and open that.</source>
            <translation>{path} är en pekare från Git LFS, tre rader som står för filen; hämta själva filen (git lfs pull) och öppna den.</translation>
        </message>
        <message>
            <source>{path} is a pressure map of {device}, and no scan of a foot; choose the scan. The map is laid under a foot by Tools, Lay a pressure map.</source>
            <translation>{path} är en tryckkarta från {device} och ingen skanning av en fot; välj skanningen. Kartan läggs under en fot med Verktyg, Lägg en tryckbild.</translation>
        </message>
        <message>
            <source>{path} is a session, which is always in millimetres; leave out the unit.</source>
            <translation>{path} är en session, som alltid är i millimeter; utelämna enheten.</translation>
        </message>
        <message>
            <source>{path} is a session, which says how the foot lies; leave out form and points.</source>
            <translation>{path} är en session, som säger hur foten ligger; utelämna form och punkter.</translation>
        </message>
        <message>
            <source>{path} is almost dark; uncover the emitter and capture the wall again.</source>
            <translation>{path} är nästan mörk; ta bort det som täcker strålaren och ta upp väggen på nytt.</translation>
        </message>
        <message>
            <source>{path} is an export of {device}, a device that is not read; save the map as a table with a row of numbers for each row of sensors, and open that.</source>
            <translation>{path} är en export från {device}, en apparat som inte läses; spara kartan som en tabell med en rad tal för varje rad sensorer, och öppna den.</translation>
        </message>
        <message>
            <source>{path} is compressed with {method}, which is not read; export it again without compression.</source>
            <translation>{path} är komprimerad med {method}, vilket inte kan läsas; exportera den igen utan komprimering.</translation>
        </message>
        <message>
            <source>{path} is cut off; export it again.</source>
            <translation>{path} är avkortad; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} is damaged or cannot be read, so the defaults are used; the file is kept as {kept}.</source>
            <translation>{path} är skadad eller kan inte läsas, så standardvärdena används; filen sparas som {kept}.</translation>
        </message>
        <message>
            <source>{path} is doubtful: {doubts} Open it in the window, or insist with --force.</source>
            <translation>{path} är osäker: {doubts} Öppna den i fönstret, eller insistera med --force.</translation>
        </message>
        <message>
            <source>{path} is doubtful: {doubts} Use --unit, --length-mm or --shoe-size.</source>
            <translation>{path} är tveksam: {doubts} Använd --unit, --length-mm eller --shoe-size.</translation>
        </message>
        <message>
            <source>{path} is empty; choose a table with one row for a person.</source>
            <translation>{path} är tom; välj en tabell med en rad för varje person.</translation>
        </message>
        <message>
            <source>{path} is empty; export it again.</source>
            <translation>{path} är tom; exportera den igen.</translation>
        </message>
        <message>
            <source>{path} is flat, which is no surface of a foot; export it again.</source>
            <translation>{path} är plan, vilket ingen fots yta är; exportera den igen.</translation>
        </message>
        <message>
            <source>{path} is in a character set that is not known, or damaged (at byte {place}); save it again as CSV UTF-8.</source>
            <translation>{path} har en okänd teckenkodning eller är skadad (vid byte {place}); spara den igen som CSV UTF-8.</translation>
        </message>
        <message>
            <source>{path} is larger than {limit_mb} MB, which no file of its kind is; choose another file.</source>
            <translation>{path} är större än {limit_mb} MB, vilket ingen sådan fil är; välj en annan fil.</translation>
        </message>
        <message>
            <source>{path} is longer than five minutes; export a part of the walk.</source>
            <translation>{path} är längre än fem minuter; exportera en del av gången.</translation>
        </message>
        <message>
            <source>{path} is named for two results; give each of them a name of its own.</source>
            <translation>{path} anges för två resultat; ge vart och ett ett eget namn.</translation>
        </message>
        <message>
            <source>{path} is named twice; name each session once.</source>
            <translation>{path} är angiven två gånger; ange varje session en gång.</translation>
        </message>
        <message>
            <source>{path} is neither a case, a session nor a mesh; open a {case_suffix} file, the folder or zip archive of a session, or a {mesh_suffixes} file.</source>
            <translation>{path} är varken ett fall, en session eller ett nät; öppna en {case_suffix}-fil, en sessions mapp eller zip-arkiv, eller en fil av typen {mesh_suffixes}.</translation>
        </message>
        <message>
            <source>{path} is no UTF-8 text; hand in a design as JSON.</source>
            <translation>{path} är ingen UTF-8-text; ange en design som JSON.</translation>
        </message>
        <message>
            <source>{path} is no infrared picture of 640×480 with 16 bits of grey; record it as the sensor sends it beside the depth.</source>
            <translation>{path} är ingen infraröd bild på 640×480 med 16 bitar gråskala; spela in den som sensorn sänder den bredvid djupet.</translation>
        </message>
        <message>
            <source>{path} is no name of a program; choose {suffixes}.</source>
            <translation>{path} är inget namn på ett program; välj {suffixes}.</translation>
        </message>
        <message>
            <source>{path} is no name of a report; let it end in {suffixes}.</source>
            <translation>{path} är inget namn på en rapport; låt det sluta på {suffixes}.</translation>
        </message>
        <message>
            <source>{path} is no raw depth image (16-bit grey, numbers up to 2047); record the raw numbers of the sensor.</source>
            <translation>{path} är ingen rå djupbild (16 bitar grått, tal till 2047); spela in sensorns råa tal.</translation>
        </message>
        <message>
            <source>{path} is no readable PNG, JPEG or TIFF; save the picture again.</source>
            <translation>{path} är ingen läsbar PNG, JPEG eller TIFF; spara bilden på nytt.</translation>
        </message>
        <message>
            <source>{path} is no readable case file; it may be damaged or cut off, so restore it from a backup.</source>
            <translation>{path} är ingen läsbar fallfil; den kan vara skadad eller avskuren, så återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{path} is no readable image; restore it or take it out of the folder.</source>
            <translation>{path} är ingen läsbar bild; återställ den eller ta bort den ur mappen.</translation>
        </message>
        <message>
            <source>{path} is no readable picture; restore it or take it out of the folder.</source>
            <translation>{path} är ingen läsbar bild; återställ den eller ta bort den ur mappen.</translation>
        </message>
        <message>
            <source>{path} is no readable text; export it again.</source>
            <translation>{path} är ingen läsbar text; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} is no scan that can be read: {kind}.</source>
            <translation>{path} är ingen skanning som kan läsas: {kind}.</translation>
        </message>
        <message>
            <source>{path} is no scan that can be read; hand in a file of one of the formats {suffixes}.</source>
            <translation>{path} är ingen skanning som kan läsas; ange en fil i något av formaten {suffixes}.</translation>
        </message>
        <message>
            <source>{path} is no sensor: name a sensor.json, or the folder that holds one.</source>
            <translation>{path} är ingen sensor: ange en sensor.json, eller mappen som innehåller en.</translation>
        </message>
        <message>
            <source>{path} is no table of text; save it again as CSV UTF-8.</source>
            <translation>{path} är ingen tabell med text; spara den igen som CSV UTF-8.</translation>
        </message>
        <message>
            <source>{path} is no text; export the pressure map as text, or save the table as CSV.</source>
            <translation>{path} är ingen text; exportera tryckbilden som text, eller spara tabellen som CSV.</translation>
        </message>
        <message>
            <source>{path} is no valid JSON: {reason}; export the design again.</source>
            <translation>{path} är ingen giltig JSON: {reason}; exportera designen igen.</translation>
        </message>
        <message>
            <source>{path} is no valid JSON; correct the texts.</source>
            <translation>{path} är ingen giltig JSON; rätta texterna.</translation>
        </message>
        <message>
            <source>{path} is no {format} file that can be read ({reason}); it may be damaged or cut off, so export it again.</source>
            <translation>{path} kan inte läsas som en {format}-fil ({reason}); den kan vara skadad eller avklippt, så exportera den igen.</translation>
        </message>
        <message>
            <source>{path} is not replaced: it holds {name}, which is not part of an earlier result; choose a new or an empty folder.</source>
            <translation>{path} ersätts inte: den innehåller {name}, som inte hör till ett tidigare resultat; välj en ny eller en tom mapp.</translation>
        </message>
        <message>
            <source>{path} is open in another program; close all windows of Insole Studio, then try again.</source>
            <translation>{path} är öppen i ett annat program; stäng alla fönster av Insole Studio och försök igen.</translation>
        </message>
        <message>
            <source>{path} is open in another window.</source>
            <translation>{path} är öppen i ett annat fönster.</translation>
        </message>
        <message>
            <source>{path} is open on another computer, {host}.</source>
            <translation>{path} är öppen på en annan dator, {host}.</translation>
        </message>
        <message>
            <source>{path} is put together from other files; export it again as one whole.</source>
            <translation>{path} är sammansatt av andra filer; exportera den på nytt som en helhet.</translation>
        </message>
        <message>
            <source>{path} is read by the library {library}, which is not installed; export the scan as .glb or .obj.</source>
            <translation>{path} läses av biblioteket {library}, som inte är installerat; exportera skanningen som .glb eller .obj.</translation>
        </message>
        <message>
            <source>{path} is read to make the result, which would replace it; give the result another name.</source>
            <translation>{path} läses för att göra resultatet, som skulle ersätta den; ge resultatet ett annat namn.</translation>
        </message>
        <message>
            <source>{path} is saturated: its dots are as bright as the sensor can tell; lower the infrared brightness or step back, and capture the wall again.</source>
            <translation>{path} är mättad: dess punkter är så ljusa som sensorn kan ange; sänk den infraröda ljusstyrkan eller öka avståndet, och ta upp väggen på nytt.</translation>
        </message>
        <message>
            <source>{path} is the folder that you work in, or holds it; name a folder within it.</source>
            <translation>{path} är mappen som du arbetar i, eller innehåller den; ange en mapp inuti den.</translation>
        </message>
        <message>
            <source>{path} is too large for a foot (more than {millions} million triangles or {points} million points); reduce it in the program that made it.</source>
            <translation>{path} är för stor för en fot (mer än {millions} miljoner trianglar eller {points} miljoner punkter); minska den i programmet som gjorde den.</translation>
        </message>
        <message>
            <source>{path} is too large for a foot (more than {most_mb} MB); reduce it in the program that made it.</source>
            <translation>{path} är för stor för en fot (mer än {most_mb} MB); minska den i programmet som gjorde den.</translation>
        </message>
        <message>
            <source>{path} is written with decimal commas, which no {format} file has; choose decimal points in the program or the system that wrote it, and export it again.</source>
            <translation>{path} är skriven med decimalkomma, vilket ingen {format}-fil har; välj decimalpunkt i programmet eller systemet som skrev den, och exportera den igen.</translation>
        </message>
        <message>
            <source>{path} is {length_mm:.0f} mm long by the size that is given, which is no foot; check the size.</source>
            <translation>{path} är {length_mm:.0f} mm lång enligt den angivna storleken, vilket inte är någon fot; kontrollera storleken.</translation>
        </message>
        <message>
            <source>{path} is {length_mm:.0f} mm long if it is read in {unit}, which is no foot; choose another unit.</source>
            <translation>{path} är {length_mm:.0f} mm lång om den läses i {unit}, vilket inte är någon fot; välj en annan enhet.</translation>
        </message>
        <message>
            <source>{path} is {width}×{height}, far larger than the pictures of a sensor; put in the pictures as it sends them.</source>
            <translation>{path} är {width}×{height}, långt större än en sensors bilder; lägg dit bilderna som den skickar dem.</translation>
        </message>
        <message>
            <source>{path} lies in the folder of the unfinished capture, which is removed; choose another place.</source>
            <translation>{path} ligger i mappen för den oavslutade avbildningen, som tas bort; välj en annan plats.</translation>
        </message>
        <message>
            <source>{path} lies so far from the origin that the last digits of its coordinates are lost: they are rounded to steps of {step:g}; export it near the origin.</source>
            <translation>{path} ligger så långt från origo att koordinaternas sista siffror gått förlorade: de är avrundade till steg om {step:g}; exportera den nära origo.</translation>
        </message>
        <message>
            <source>{path} may not be read; ask for permission.</source>
            <translation>{path} får inte läsas; be om behörighet.</translation>
        </message>
        <message>
            <source>{path} measures {length:g} in its longest direction, which is no foot in millimetres, centimetres, metres or inches; check the unit of the export.</source>
            <translation>{path} mäter {length:g} i sin längsta riktning, vilket inte är någon fot i millimeter, centimeter, meter eller tum; kontrollera exportens enhet.</translation>
        </message>
        <message>
            <source>{path} names corners that it does not hold; it is damaged, so export it again.</source>
            <translation>{path} anger hörn som den inte innehåller; den är skadad, så exportera den igen.</translation>
        </message>
        <message>
            <source>{path} names no form of a report; let it end in {suffixes}.</source>
            <translation>{path} anger ingen form av rapport; låt namnet sluta på {suffixes}.</translation>
        </message>
        <message>
            <source>{path} names no format that {what} is written as; choose {formats}.</source>
            <translation>{path} anger inget format som {what} skrivs i; välj {formats}.</translation>
        </message>
        <message>
            <source>{path} says that its sensors are {pitch:g} mm apart, and they are {low:g} to {high:g} mm apart; export it again.</source>
            <translation>{path} anger att dess sensorer ligger {pitch:g} mm isär, och de ligger {low:g} till {high:g} mm isär; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path} was captured with the reference system {own}, but the body carries that of {needed}; choose it before the capture, and stand the body alone before the sensors.</source>
            <translation>{path} spelades in med referenssystemet {own}, men kroppen bär det som heter {needed}; välj det före inspelningen, och ställ kroppen ensam framför sensorerna.</translation>
        </message>
        <message>
            <source>{path} was changed by another program since it was opened here.</source>
            <translation>{path} har ändrats av ett annat program sedan den öppnades här.</translation>
        </message>
        <message>
            <source>{path} was changed since the record stored it; restore it from a backup.</source>
            <translation>{path} har ändrats sedan journalen sparade den; återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{path} was changed while it was being stored; try again.</source>
            <translation>{path} ändrades medan den sparades; försök igen.</translation>
        </message>
        <message>
            <source>{path} was recorded with both feet, but one surface is compared; reconstruct its feet and give the mesh of one.</source>
            <translation>{path} spelades in med båda fötterna, men en yta jämförs; rekonstruera fötterna och ange den enas yta.</translation>
        </message>
        <message>
            <source>{path} was recorded with both feet; a repeat test takes one foot.</source>
            <translation>{path} spelades in med båda fötterna; ett upprepningsprov görs med en fot.</translation>
        </message>
        <message>
            <source>{path} was recorded with both feet; capture the object alone, in the place of one foot.</source>
            <translation>{path} spelades in med båda fötterna; spela in föremålet ensamt, på en fots plats.</translation>
        </message>
        <message>
            <source>{path} was recorded with both feet; say which one, with --side left or --side right.</source>
            <translation>{path} spelades in med båda fötterna; ange vilken, med --side left eller --side right.</translation>
        </message>
        <message>
            <source>{path}, a copy of unsaved work that is damaged, was kept for {days} days and is removed now.</source>
            <translation>{path}, en skadad kopia av osparat arbete, har sparats i {days} dagar och tas nu bort.</translation>
        </message>
        <message>
            <source>{path}: "{text}" is no distance of sensors; write such as 5 or 5 x 7.</source>
            <translation>{path}: ”{text}” är inget avstånd mellan sensorer; skriv till exempel 5 eller 5 x 7.</translation>
        </message>
        <message>
            <source>{path}: line {line} holds "{text}" in place of a pressure; export it again.</source>
            <translation>{path}: rad {line} innehåller ”{text}” i stället för ett tryck; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path}: the frames differ in the number of their rows or columns; export it again.</source>
            <translation>{path}: bilderna har olika antal rader eller kolumner; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path}: the pressures of a frame do not make up the force that it states; the file is damaged, so export it again.</source>
            <translation>{path}: trycken i en bild ger inte den kraft som den anger; filen är skadad, så exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path}: the rows of the table differ in length; export it again.</source>
            <translation>{path}: tabellens rader är olika långa; exportera den på nytt.</translation>
        </message>
        <message>
            <source>{path}: the unit "{unit}" is none of pressure; calibrate the recording and export it in kPa.</source>
            <translation>{path}: enheten ”{unit}” är ingen enhet för tryck; kalibrera mätningen och exportera den i kPa.</translation>
        </message>
        <message>
            <source>{path}: {entries} cannot be understood, so the defaults are used for them; the file is kept as {kept}.</source>
            <translation>{path}: {entries} går inte att förstå, så standardvärdena används för dem; filen sparas som {kept}.</translation>
        </message>
        <message>
            <source>{path}: {file} is damaged; restore the file from a backup.</source>
            <translation>{path}: {file} är skadad; återställ filen från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{path}: {reason}</source>
            <translation>{path}: {reason}</translation>
        </message>
        <message>
            <source>{percent:.0f} %, {mass:.1f} g</source>
            <translation>{percent:.0f} %, {mass:.1f} g</translation>
        </message>
        <message>
            <source>{pictures} pictures show enough markers and {markers} markers are seen twice; take at least {least} pictures (better 15) from all sides.</source>
            <translation>{pictures} bilder visar tillräckligt många markörer och {markers} markörer syns två gånger; ta minst {least} bilder (helst 15) från alla håll.</translation>
        </message>
        <message>
            <source>{picture} holds the number {number}, but the sensor's raw numbers end at {greatest}; it is no raw depth frame.</source>
            <translation>{picture} innehåller talet {number}, men sensorns råvärden slutar vid {greatest}; det är ingen rå djupbild.</translation>
        </message>
        <message>
            <source>{picture} is blurred (an edge takes {edge_px:.1f} px); hold the board still and take the picture again.</source>
            <translation>{picture} är oskarp (en kant tar {edge_px:.1f} px); håll brädet stilla och ta bilden igen.</translation>
        </message>
        <message>
            <source>{picture} was left out: {reason}</source>
            <translation>{picture} utelämnades: {reason}</translation>
        </message>
        <message>
            <source>{picture}: a chequerboard is seen, but not one of {board}; show all of it, or count its inner corners (a row has one less than squares).</source>
            <translation>{picture}: ett schackbräde syns, men inte ett med {board}; visa hela, eller räkna dess inre hörn (en rad har ett hörn mindre än rutor).</translation>
        </message>
        <message>
            <source>{picture}: no chequerboard of {board} is seen; show the whole board, flat and well lit.</source>
            <translation>{picture}: inget schackbräde med {board} syns; visa hela brädet, plant och väl belyst.</translation>
        </message>
        <message>
            <source>{picture}: {corners} corners of the ChArUco board of {columns}×{rows} squares are seen, but {least} are needed; show more of the board, and check its size and dictionary.</source>
            <translation>{picture}: {corners} hörn av ChArUco-brädet med {columns}×{rows} rutor syns, men {least} behövs; visa mer av brädet, och kontrollera dess storlek och förteckning.</translation>
        </message>
        <message>
            <source>{piece} carries no mark: {reason}</source>
            <translation>{piece} är omärkt: {reason}</translation>
        </message>
        <message>
            <source>{piece} is no closed solid: it is open, crosses itself, or is made of layers; export the order again in one piece.</source>
            <translation>{piece} är ingen sluten kropp: den är öppen, skär sig själv eller består av lager; exportera beställningen igen i ett stycke.</translation>
        </message>
        <message>
            <source>{piece} is {need:.1f} mm high, and the block has {there:g} mm; take a higher block.</source>
            <translation>{piece} är {need:.1f} mm högt, och blocket har {there:g} mm; ta ett högre block.</translation>
        </message>
        <message>
            <source>{piece} was written without its quantity, and lies here once; compare it with the order.</source>
            <translation>{piece} skrevs utan sitt antal och ligger här en gång; jämför med beställningen.</translation>
        </message>
        <message>
            <source>{piece}: {told}</source>
            <translation>{piece}: {told}</translation>
        </message>
        <message>
            <source>{placed} of {count} pieces find room on {block}; take a larger block, less room beside the pieces, or fewer orders.</source>
            <translation>{placed} av {count} stycken får plats på {block}; ta ett större block, mindre utrymme bredvid styckena eller färre beställningar.</translation>
        </message>
        <message>
            <source>{place} answers, and asks for a password; type it, or write it into PostgreSQL's password file.</source>
            <translation>{place} svarar och frågar efter ett lösenord; skriv det, eller lägg det i PostgreSQL:s lösenordsfil.</translation>
        </message>
        <message>
            <source>{place} answers, and does not let this computer in ({reason}); ask whoever looks after the server.</source>
            <translation>{place} svarar men släpper inte in den här datorn ({reason}); fråga den som sköter servern.</translation>
        </message>
        <message>
            <source>{place} answers, and has no such database ({reason}); check the name in the address, or let whoever looks after the server make it.</source>
            <translation>{place} svarar men har ingen sådan databas ({reason}); kontrollera namnet i adressen, eller låt den som sköter servern skapa den.</translation>
        </message>
        <message>
            <source>{place} answers, and refuses the user or the password ({reason}); check the user in the address of the database, and type its password again or correct PostgreSQL's password file.</source>
            <translation>{place} svarar men avvisar användaren eller lösenordet ({reason}); kontrollera användaren i databasens adress och skriv lösenordet igen eller rätta PostgreSQL:s lösenordsfil.</translation>
        </message>
        <message>
            <source>{place} answers, but not so that it can be trusted ({reason}); ask whoever looks after the server for its certificate.</source>
            <translation>{place} svarar, men inte så att det går att lita på ({reason}); fråga den som sköter servern om dess certifikat.</translation>
        </message>
        <message>
            <source>{place} cannot be opened or read ({reason}); check that its disk or share is connected, and that you may read and write there.</source>
            <translation>{place} kan inte öppnas eller läsas ({reason}); kontrollera att dess disk eller delade mapp är ansluten och att du får läsa och skriva där.</translation>
        </message>
        <message>
            <source>{place} comes from an older Insole Studio and cannot be brought up to date, since it may only be read; ask for the right to write to it.</source>
            <translation>{place} kommer från ett äldre Insole Studio och kan inte uppdateras, eftersom den bara får läsas; be om rätten att skriva till den.</translation>
        </message>
        <message>
            <source>{place} does not answer ({reason}); check the network, the address and that the database is running.</source>
            <translation>{place} svarar inte ({reason}); kontrollera nätverket, adressen och att databasen är igång.</translation>
        </message>
        <message>
            <source>{place} has tables of which no Insole Studio knows ({found}); name another record, or restore this one from a backup.</source>
            <translation>{place} har tabeller som inget Insole Studio känner till ({found}); ange en annan journal, eller återställ denna från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{place} holds a record that cannot be read.</source>
            <translation>{place} innehåller en journal som inte går att läsa.</translation>
        </message>
        <message>
            <source>{place} holds a record that is newer than the backup: {count} entries of its audit log are not in it, the last of {last_at} UTC ({kinds}).</source>
            <translation>{place} innehåller en journal som är nyare än säkerhetskopian: {count} poster i loggen finns inte i den, den senaste från {last_at} UTC ({kinds}).</translation>
        </message>
        <message>
            <source>{place} holds a record with {count} entries fewer in its audit log than the backup.</source>
            <translation>{place} innehåller en journal med {count} poster färre i loggen än säkerhetskopian.</translation>
        </message>
        <message>
            <source>{place} holds another record than the backup.</source>
            <translation>{place} innehåller en annan journal än säkerhetskopian.</translation>
        </message>
        <message>
            <source>{place} holds something that cannot be read ({reason}), so another program has changed it; verify the record, and restore it from a backup.</source>
            <translation>{place} innehåller något som inte kan läsas ({reason}), så ett annat program har ändrat den; kontrollera journalen och återställ den från en säkerhetskopia.</translation>
        </message>
        <message>
            <source>{place} holds the record as the backup has it: nothing was changed since.</source>
            <translation>{place} innehåller journalen som den är i säkerhetskopian: ingenting har ändrats sedan dess.</translation>
        </message>
        <message>
            <source>{place} is damaged; restore the record from a backup, and keep the damaged file until that has been checked.</source>
            <translation>{place} är skadad; återställ journalen från en säkerhetskopia och behåll den skadade filen tills återställningen har kontrollerats.</translation>
        </message>
        <message>
            <source>{place} is held by another program; wait until that has finished, and try again.</source>
            <translation>{place} hålls av ett annat program; vänta tills det är klart och försök igen.</translation>
        </message>
        <message>
            <source>{place} is the database of another program; name the folder of a record.</source>
            <translation>{place} är ett annat programs databas; ange mappen för en journal.</translation>
        </message>
        <message>
            <source>{place} may not be changed by you; ask for the right to write to it.</source>
            <translation>Du får inte ändra {place}; be om rätten att skriva till den.</translation>
        </message>
        <message>
            <source>{place} names a computer that nobody knows here ({reason}); check the address of the database, and that this computer is in the network.</source>
            <translation>{place} är namnet på en dator som ingen känner till här ({reason}); kontrollera databasens adress och att den här datorn är i nätverket.</translation>
        </message>
        <message>
            <source>{place} refused what was to be written ({reason}); nothing was changed. Please report this.</source>
            <translation>{place} vägrade ta emot det som skulle skrivas ({reason}); inget ändrades. Rapportera gärna detta.</translation>
        </message>
        <message>
            <source>{place} takes no changes, as a server that stands by for another one; check the address of the database, or ask whoever looks after it.</source>
            <translation>{place} tar inte emot några ändringar, som en server som står i beredskap för en annan; kontrollera databasens adress, eller fråga den som sköter den.</translation>
        </message>
        <message>
            <source>{place} takes no more connections at the moment; close windows or programs that use it, or let whoever looks after the server allow more (max_connections).</source>
            <translation>{place} tar inte emot fler anslutningar just nu; stäng fönster eller program som använder den, eller låt den som sköter servern tillåta fler (max_connections).</translation>
        </message>
        <message>
            <source>{place} was made by a newer Insole Studio (tables {found}; this program knows them up to {newest}); install the newest version.</source>
            <translation>{place} har skapats av ett nyare Insole Studio (tabeller {found}; det här programmet känner dem till och med {newest}); installera den nyaste versionen.</translation>
        </message>
        <message>
            <source>{place}: the views {first} and {second} name one sensor, {serial}, but two cameras of different kind or calibration; give each view the sensor.json of its own camera.</source>
            <translation>{place}: vyerna {first} och {second} anger en och samma sensor, {serial}, men två kameror av olika sort eller kalibrering; ge varje vy sensor.json från dess egen kamera.</translation>
        </message>
        <message>
            <source>{printer} has no pattern {pattern}; choose another pattern, such as gyroid, or another printer.</source>
            <translation>{printer} har inget mönster {pattern}; välj ett annat mönster, till exempel gyroid, eller en annan skrivare.</translation>
        </message>
        <message>
            <source>{problem} Kept so far: {views}.</source>
            <translation>{problem} Sparat hittills: {views}.</translation>
        </message>
        <message>
            <source>{problem}; calibrate this sensor, or insist on using it with a warning.</source>
            <translation>{problem}; kalibrera den här sensorn, eller använd den ändå med en varning.</translation>
        </message>
        <message>
            <source>{problem}; the depth may be wrong by several millimetres.</source>
            <translation>{problem}; djupet kan vara fel med flera millimeter.</translation>
        </message>
        <message>
            <source>{pseudonym} orders the {side} foot, and no file is there to make it from; ask the clinic for it.</source>
            <translation>{pseudonym} beställer sidan {side}, och ingen fil finns att tillverka den från; be kliniken om den.</translation>
        </message>
        <message>
            <source>{rearfoot} / {forefoot}</source>
            <translation>{rearfoot} / {forefoot}</translation>
        </message>
        <message>
            <source>{reason} No infrared pictures of sensor {serial} were taken; its own depth is used.</source>
            <translation>{reason} Inga infraröda bilder togs med sensorn {serial}; dess eget djup används.</translation>
        </message>
        <message>
            <source>{reason} The sensor's own depth was used.</source>
            <translation>{reason} Sensorns eget djup användes.</translation>
        </message>
        <message>
            <source>{reason} Until then the learnt correction is used.</source>
            <translation>{reason} Tills dess används den inlärda korrektionen.</translation>
        </message>
        <message>
            <source>{region} {percent:.0f} %</source>
            <translation>{region} {percent:.0f} %</translation>
        </message>
        <message>
            <source>{region}: cannot tell.</source>
            <translation>{region}: kan inte säga.</translation>
        </message>
        <message>
            <source>{region}: {percent} % of the peak pressure, {low} to {high} %.</source>
            <translation>{region}: {percent} % av topptrycket, {low} till {high} %.</translation>
        </message>
        <message>
            <source>{scan} does not fit what was captured, wherever it is laid; name the scan of the same body, and check its unit.</source>
            <translation>{scan} passar inte det som spelades in, hur den än läggs; ange skanningen av samma kropp och kontrollera dess enhet.</translation>
        </message>
        <message>
            <source>{scan} fits what was captured only as its mirror image; name the scan of the same side, and check that neither is flipped.</source>
            <translation>{scan} passar det som spelades in bara spegelvänd; ange skanningen av samma sida och kontrollera att ingen av dem är spegelvänd.</translation>
        </message>
        <message>
            <source>{scan} is {size_mm:.0f} mm long, but would have to be {found_mm:.0f} mm long to fit what was captured; check its unit, and that it is of the same body.</source>
            <translation>{scan} är {size_mm:.0f} mm lång men skulle behöva vara {found_mm:.0f} mm lång för att passa det som spelades in; kontrollera dess enhet och att den är av samma kropp.</translation>
        </message>
        <message>
            <source>{serial}, model {model}, device {release}, USB controller {bus}</source>
            <translation>{serial}, modell {model}, enhet {release}, USB-styrenhet {bus}</translation>
        </message>
        <message>
            <source>{serial}: nobody has noted when</source>
            <translation>{serial}: ingen har antecknat när</translation>
        </message>
        <message>
            <source>{serial}: {days:.0f} days old</source>
            <translation>{serial}: {days:.0f} dagar gammal</translation>
        </message>
        <message>
            <source>{serial}: {step} {value:.2f} {unit}</source>
            <translation>{serial}: {step} {value:.2f} {unit}</translation>
        </message>
        <message>
            <source>{session} cannot be played back, because its view {view} was recorded by a {model}, neither a Kinect nor a stereo camera; reconstruct it instead.</source>
            <translation>{session} kan inte spelas upp, eftersom dess vy {view} togs med en {model}, varken en Kinect eller en stereokamera; rekonstruera den i stället.</translation>
        </message>
        <message>
            <source>{session} was recorded with both feet, but no {side} foot is in its place; capture both again, or choose the {other} foot alone.</source>
            <translation>{session} spelades in med båda fötterna, men ingen {side} fot är på sin plats; avbilda båda igen, eller välj enbart {other} fot.</translation>
        </message>
        <message>
            <source>{shape}, diameter {diameter} mm, flutes {flute} mm, length {reach} mm to the collet, of which {free} mm are needed; {rpm:.0f} rpm, {time}</source>
            <translation>{shape}, diameter {diameter} mm, skär {flute} mm, längd {reach} mm till spännhylsan, varav {free} mm behövs; {rpm:.0f} varv/min, {time}</translation>
        </message>
        <message>
            <source>{share:.0%} of the image was never filled by a wall; move the board there.</source>
            <translation>{share:.0%} av bilden fylldes aldrig av en vägg; flytta skivan dit.</translation>
        </message>
        <message>
            <source>{share:.0%} of the {pad} lie on the transition to the rim; move it inwards or set a narrower transition.</source>
            <translation>{share:.0%} av {pad} ligger på övergången till randen; flytta den inåt eller ställ in en smalare övergång.</translation>
        </message>
        <message>
            <source>{side} foot</source>
            <translation>{side} fot</translation>
        </message>
        <message>
            <source>{side}: {work}</source>
            <translation>{side}: {work}</translation>
        </message>
        <message>
            <source>{sign}{value} {limits}{unit}</source>
            <translation>{sign}{value} {limits}{unit}</translation>
        </message>
        <message>
            <source>{size:.1f} MB on this computer</source>
            <translation>{size:.1f} MB på den här datorn</translation>
        </message>
        <message>
            <source>{surface_mm:.0f} mm of it scanned, without toes</source>
            <translation>{surface_mm:.0f} mm av den skannade, utan tår</translation>
        </message>
        <message>
            <source>{text} can be {days}; write the one that is meant.</source>
            <translation>{text} kan vara {days}; skriv den som avses.</translation>
        </message>
        <message>
            <source>{text} can be {first} or {second}; say whether day or month comes first.</source>
            <translation>{text} kan vara {first} eller {second}; ange om dag eller månad kommer först.</translation>
        </message>
        <message>
            <source>{text} can be {first} or {second}; write the one that is meant.</source>
            <translation>{text} kan vara {first} eller {second}; skriv den som avses.</translation>
        </message>
        <message>
            <source>{text} holds a day in the future; check its year.</source>
            <translation>{text} innehåller en dag i framtiden; kontrollera året.</translation>
        </message>
        <message>
            <source>{text} holds a day that the calendar does not have; check it.</source>
            <translation>{text} innehåller en dag som inte finns i kalendern; kontrollera den.</translation>
        </message>
        <message>
            <source>{text} is no Swedish personal number; write it as YYYYMMDD-NNNN.</source>
            <translation>{text} är inget svenskt personnummer; skriv det som ÅÅÅÅMMDD-NNNN.</translation>
        </message>
        <message>
            <source>{text} is no date; write year, month and day, such as 1970-02-28.</source>
            <translation>{text} är inget datum; skriv år, månad och dag, till exempel 1970-02-28.</translation>
        </message>
        <message>
            <source>{text} is no number; write it such as 72.5.</source>
            <translation>{text} är inget tal; skriv det till exempel som 72.5.</translation>
        </message>
        <message>
            <source>{text} is not between {first} and {last}; check the year.</source>
            <translation>{text} ligger inte mellan {first} och {last}; kontrollera året.</translation>
        </message>
        <message>
            <source>{text}: by its markers the print in {capture} differs from that by x {x:+.1f} %, y {y:+.1f} %, z {z:+.1f} % and {skew:.1f}° of skew; measure the bar that was printed with it again, and name the readings with --callipers, or, if they are right, calibrate the sensors.</source>
            <translation>{text}: att döma av markörerna avviker utskriften i {capture} från det med x {x:+.1f} %, y {y:+.1f} %, z {z:+.1f} % och {skew:.1f}° skevhet; mät staven som skrevs ut med den igen, och ange avläsningarna med --callipers, eller kalibrera sensorerna om de stämmer.</translation>
        </message>
        <message>
            <source>{text}: what was captured is {percent:+.1f} % off that size; measure the bar that was printed with it again, and name the readings with --callipers.</source>
            <translation>{text}: det som spelades in avviker {percent:+.1f} % från den storleken; mät staven som skrevs ut med den igen, och ange avläsningarna med --callipers.</translation>
        </message>
        <message>
            <source>{thin} of {count} tabs stay thinner than the {asked:g} mm that were asked for, the thinnest {least:.1f} mm: the edge is thin or steep there, or no block stays beside it. Hold the piece down when it comes free, or leave more of the block beside it.</source>
            <translation>{thin} av {count} hållflikar blir tunnare än de {asked:g} mm som begärdes, den tunnaste {least:.1f} mm: kanten är tunn eller brant där, eller inget block blir kvar intill dem. Håll fast stycket när det lossnar, eller låt mer av blocket bli kvar bredvid det.</translation>
        </message>
        <message>
            <source>{told} And {more} more; verify the order.</source>
            <translation>{told} Och {more} till; kontrollera beställningen.</translation>
        </message>
        <message>
            <source>{used} of {taken} walls were used, {nearest_mm:.0f} to {farthest_mm:.0f} mm; {share:.0%} of the pattern was seen often enough.</source>
            <translation>{used} av {taken} väggar användes, {nearest_mm:.0f} till {farthest_mm:.0f} mm; {share:.0%} av mönstret sågs tillräckligt ofta.</translation>
        </message>
        <message>
            <source>{used} of {taken} walls were used; they cover {share:.0%} of the image.</source>
            <translation>{used} av {taken} väggar användes; de täcker {share:.0%} av bilden.</translation>
        </message>
        <message>
            <source>{value:.0f} cm²</source>
            <translation>{value:.0f} cm²</translation>
        </message>
        <message>
            <source>{value:.1f}</source>
            <translation>{value:.1f}</translation>
        </message>
        <message>
            <source>{value:.1f} mm</source>
            <translation>{value:.1f} mm</translation>
        </message>
        <message>
            <source>{value:.1f} {limits} mm</source>
            <translation>{value:.1f} {limits} mm</translation>
        </message>
        <message>
            <source>{value:.2f}</source>
            <translation>{value:.2f}</translation>
        </message>
        <message>
            <source>{value:.2f} mm</source>
            <translation>{value:.2f} mm</translation>
        </message>
        <message>
            <source>{value:g}</source>
            <translation>{value:g}</translation>
        </message>
        <message>
            <source>{value:g} {unit} at {place}; {limit:g} is the {bound} allowed.</source>
            <translation>{value:g} {unit} vid {place}; {limit:g} är det {bound} tillåtna.</translation>
        </message>
        <message>
            <source>{value:g}°</source>
            <translation>{value:g}°</translation>
        </message>
        <message>
            <source>{value} % of the length</source>
            <translation>{value} % av längden</translation>
        </message>
        <message>
            <source>{value} ahead of the heads</source>
            <translation>{value} framför huvudena</translation>
        </message>
        <message>
            <source>{value} at the forefoot</source>
            <translation>{value} i framfoten</translation>
        </message>
        <message>
            <source>{value} at the rearfoot</source>
            <translation>{value} i bakfoten</translation>
        </message>
        <message>
            <source>{value} behind the heads</source>
            <translation>{value} bakom huvudena</translation>
        </message>
        <message>
            <source>{value} deep</source>
            <translation>{value} djup</translation>
        </message>
        <message>
            <source>{value} high</source>
            <translation>{value} hög</translation>
        </message>
        <message>
            <source>{value} long</source>
            <translation>{value} lång</translation>
        </message>
        <message>
            <source>{value} mm from the bisection of the 1st metatarsal</source>
            <translation>{value} mm från första metatarsalbenets delningslinje</translation>
        </message>
        <message>
            <source>{value} of it at the heads</source>
            <translation>{value} av det vid huvudena</translation>
        </message>
        <message>
            <source>{value} over the floor</source>
            <translation>{value} över golvet</translation>
        </message>
        <message>
            <source>{value} {limits}</source>
            <translation>{value} {limits}</translation>
        </message>
        <message>
            <source>{value} {limits} mm</source>
            <translation>{value} {limits} mm</translation>
        </message>
        <message>
            <source>{value} {limits}°</source>
            <translation>{value} {limits}°</translation>
        </message>
        <message>
            <source>{value} {limits}° {word}</source>
            <translation>{value} {limits}° {word}</translation>
        </message>
        <message>
            <source>{value}: {reason}</source>
            <translation>{value}: {reason}</translation>
        </message>
        <message>
            <source>{view} is left out: {reason}.</source>
            <translation>{view} utelämnas: {reason}.</translation>
        </message>
        <message>
            <source>{view} {share:.0%}</source>
            <translation>{view} {share:.0%}</translation>
        </message>
        <message>
            <source>{volume:.1f} cm³</source>
            <translation>{volume:.1f} cm³</translation>
        </message>
        <message>
            <source>{what} is {value:g}, and must be {least} to {most} {unit}; put in a value of that range.</source>
            <translation>{what} är {value:g}, och måste vara {least} till {most} {unit}; ange ett värde i det området.</translation>
        </message>
        <message>
            <source>{what} was left out: {reason}</source>
            <translation>{what} utelämnades: {reason}</translation>
        </message>
        <message>
            <source>{what} {count}</source>
            <translation>{what} {count}</translation>
        </message>
        <message>
            <source>{what}: {before} → {after}</source>
            <translation>{what}: {before} → {after}</translation>
        </message>
        <message>
            <source>{what}: {reason}</source>
            <translation>{what}: {reason}</translation>
        </message>
        <message>
            <source>{where} has the key "{key}", which this version does not know; check its spelling or leave it out.</source>
            <translation>{where} har nyckeln ”{key}”, som denna version inte känner; kontrollera stavningen eller utelämna den.</translation>
        </message>
        <message>
            <source>{where} is of the type {type}, which this version does not know; it knows {known}.</source>
            <translation>{where} är av typen {type}, som denna version inte känner; den känner {known}.</translation>
        </message>
        <message>
            <source>{where} is of version {version}, which is newer than this program (it reads up to {newest}); install a newer Insole Studio.</source>
            <translation>{where} har version {version}, som är nyare än detta program (det läser upp till {newest}); installera en nyare Insole Studio.</translation>
        </message>
        <message>
            <source>{where} is too large a number; put in a usual one.</source>
            <translation>{where} är ett för stort tal; ange ett vanligt.</translation>
        </message>
        <message>
            <source>{where} lacks the key "{key}"; add it.</source>
            <translation>{where} saknar nyckeln ”{key}”; lägg till den.</translation>
        </message>
        <message>
            <source>{where} must be a JSON object, with keys and values in {{ }}.</source>
            <translation>{where} måste vara ett JSON-objekt, med nycklar och värden i {{ }}.</translation>
        </message>
        <message>
            <source>{where} must be a list of numbers; put them in [ ].</source>
            <translation>{where} måste vara en lista med tal; sätt dem inom [ ].</translation>
        </message>
        <message>
            <source>{where} must be a list of objects; put them in [ ].</source>
            <translation>{where} måste vara en lista med objekt; sätt dem inom [ ].</translation>
        </message>
        <message>
            <source>{where} must be a list of places, each two numbers in [ ].</source>
            <translation>{where} måste vara en lista med platser, var och en två tal i [ ].</translation>
        </message>
        <message>
            <source>{where} must be a number, and is {value}.</source>
            <translation>{where} måste vara ett tal, och är {value}.</translation>
        </message>
        <message>
            <source>{where} must be a text; write it in quotation marks.</source>
            <translation>{where} måste vara en text; skriv den inom citattecken.</translation>
        </message>
        <message>
            <source>{where} must be true or false.</source>
            <translation>{where} måste vara true eller false.</translation>
        </message>
        <message>
            <source>{where} must be two numbers in [ ].</source>
            <translation>{where} måste vara två tal i [ ].</translation>
        </message>
        <message>
            <source>{works} (SHA-256 {digest})</source>
            <translation>{works} (SHA-256 {digest})</translation>
        </message>
        <message>
            <source>{zone} to {other} {density:g} %</source>
            <translation>{zone} till {other} {density:g} %</translation>
        </message>
        <message>
            <source>{zone} {density:g} %</source>
            <translation>{zone} {density:g} %</translation>
        </message>
        <message>
            <source>{zone}: {percent:.0f} %</source>
            <translation>{zone}: {percent:.0f} %</translation>
        </message>
        <message>
            <source>± ?: not known for this value</source>
            <translation>± ?: okänt för detta värde</translation>
        </message>
        <message>
            <source>± ?: not known of another scanner's file</source>
            <translation>± ?: okänt för en annan skanners fil</translation>
        </message>
        <message>
            <source>± {limits:.1f}</source>
            <translation>± {limits:.1f}</translation>
        </message>
        <message>
            <source>± {limits:.2f}</source>
            <translation>± {limits:.2f}</translation>
        </message>
        <message>
            <source>± {number} mm</source>
            <translation>± {number} mm</translation>
        </message>
        <message>
            <source>±: 95 % limits, by simulated captures</source>
            <translation>±: 95 %-gränser, enligt simulerade avbildningar</translation>
        </message>
        <message>
            <source>±: 95 % limits, by the repeat test of this place</source>
            <translation>±: 95 %-gränser, enligt den här mätplatsens upprepningsprov</translation>
        </message>
        <message>
            <source>“{zone}”</source>
            <translation>”{zone}”</translation>
        </message>
        <message>
            <source>≈ {value}</source>
            <translation>≈ {value}</translation>
        </message>
    </context>
</TS>

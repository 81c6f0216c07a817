<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>&amp;Case</source>
            <translation>&amp;Fall</translation>
        </message>
        <message>
            <source>&amp;Edit</source>
            <translation>&amp;Redigera</translation>
        </message>
        <message>
            <source>&amp;Help</source>
            <translation>&amp;Hjälp</translation>
        </message>
        <message>
            <source>&amp;Prescribe</source>
            <translation>&amp;Ordinera</translation>
        </message>
        <message>
            <source>&amp;Tools</source>
            <translation>Ver&amp;ktyg</translation>
        </message>
        <message>
            <source>&amp;View</source>
            <translation>&amp;Visa</translation>
        </message>
        <message>
            <source>A pelott</source>
            <translation>En pelott</translation>
        </message>
        <message>
            <source>A plane to look at the foot against</source>
            <translation>Ett plan att betrakta foten mot</translation>
        </message>
        <message>
            <source>A scan</source>
            <translation>En skanning</translation>
        </message>
        <message>
            <source>About Insole Studio</source>
            <translation>Om Insole Studio</translation>
        </message>
        <message>
            <source>Achilles lean</source>
            <translation>Akilles lutning</translation>
        </message>
        <message>
            <source>Achilles to sole</source>
            <translation>Akilles mot fotsula</translation>
        </message>
        <message>
            <source>Achilles, lower</source>
            <translation>Akilles, nedre</translation>
        </message>
        <message>
            <source>Achilles, upper</source>
            <translation>Akilles, övre</translation>
        </message>
        <message>
            <source>Add: {name}</source>
            <translation>Lägg till: {name}</translation>
        </message>
        <message>
            <source>All at once</source>
            <translation>Alla på en gång</translation>
        </message>
        <message>
            <source>All views are captured.</source>
            <translation>Alla vyer är avbildade.</translation>
        </message>
        <message>
            <source>An insole begins with a scan: captured with the sensors, or imported from any scanner. Click on “Open the example”, whose scan is done.</source>
            <translation>Ett inlägg börjar med en skanning: avbildad med sensorerna eller importerad från vilken skanner som helst. Klicka på ”Öppna exemplet”, vars skanning är gjord.</translation>
        </message>
        <message>
            <source>Angles of the feet</source>
            <translation>Fötternas vinklar</translation>
        </message>
        <message>
            <source>Angles of the feet…</source>
            <translation>Fötternas vinklar…</translation>
        </message>
        <message>
            <source>Anterior</source>
            <translation>Framifrån</translation>
        </message>
        <message>
            <source>Apply a template</source>
            <translation>Använd en mall</translation>
        </message>
        <message>
            <source>Apply template…</source>
            <translation>Använd mall…</translation>
        </message>
        <message>
            <source>Arch and midfoot</source>
            <translation>Fotvalv och mellanfot</translation>
        </message>
        <message>
            <source>Arch apex</source>
            <translation>Valvets topp</translation>
        </message>
        <message>
            <source>Arch height</source>
            <translation>Valvhöjd</translation>
        </message>
        <message>
            <source>Arch height index</source>
            <translation>Valvhöjdsindex</translation>
        </message>
        <message>
            <source>Arch index</source>
            <translation>Valvindex</translation>
        </message>
        <message>
            <source>Arch to a height</source>
            <translation>Fotvalv till en höjd</translation>
        </message>
        <message>
            <source>As the size tells</source>
            <translation>Som storleken säger</translation>
        </message>
        <message>
            <source>Back from Check &amp; export and Compare; first stop what is being made</source>
            <translation>Tillbaka från Kontroll &amp; export och Jämför; avbryt först det som görs</translation>
        </message>
        <message>
            <source>Back to the design; what is chosen here is kept</source>
            <translation>Tillbaka till designen; det som är valt här behålls</translation>
        </message>
        <message>
            <source>Ball girth</source>
            <translation>Trampdynans omfång</translation>
        </message>
        <message>
            <source>Ball length</source>
            <translation>Längd till trampdynan</translation>
        </message>
        <message>
            <source>Ball width across</source>
            <translation>Trampdynans bredd tvärs</translation>
        </message>
        <message>
            <source>Begin with an empty case</source>
            <translation>Börja med ett tomt fall</translation>
        </message>
        <message>
            <source>Bursts: </source>
            <translation>Serier: </translation>
        </message>
        <message>
            <source>Calcaneus, lower</source>
            <translation>Hälben, nedre</translation>
        </message>
        <message>
            <source>Calcaneus, upper</source>
            <translation>Hälben, övre</translation>
        </message>
        <message>
            <source>Calibrate sensors…</source>
            <translation>Kalibrera sensorer…</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>Avbryt</translation>
        </message>
        <message>
            <source>Capture a foot with the sensors</source>
            <translation>Avbilda en fot med sensorerna</translation>
        </message>
        <message>
            <source>Capture again</source>
            <translation>Avbilda igen</translation>
        </message>
        <message>
            <source>Capture all views (F5)</source>
            <translation>Avbilda alla vyer (F5)</translation>
        </message>
        <message>
            <source>Capture anew</source>
            <translation>Avbilda på nytt</translation>
        </message>
        <message>
            <source>Capture missing views</source>
            <translation>Avbilda saknade vyer</translation>
        </message>
        <message>
            <source>Capture…</source>
            <translation>Avbilda…</translation>
        </message>
        <message>
            <source>Centimetres</source>
            <translation>Centimeter</translation>
        </message>
        <message>
            <source>Change the order of the corrections</source>
            <translation>Ändra korrigeringarnas ordning</translation>
        </message>
        <message>
            <source>Check &amp; export</source>
            <translation>Kontroll &amp; export</translation>
        </message>
        <message>
            <source>Checking the session</source>
            <translation>Kontrollerar sessionen</translation>
        </message>
        <message>
            <source>Choose the last…</source>
            <translation>Välj läst…</translation>
        </message>
        <message>
            <source>Choose the section tool and click on the sole.</source>
            <translation>Välj snittverktyget och klicka på fotsulan.</translation>
        </message>
        <message>
            <source>Choose the shoe</source>
            <translation>Välj skon</translation>
        </message>
        <message>
            <source>Choose the shoe by size or last, see where the insole is wider, and trim it</source>
            <translation>Välj skon efter storlek eller läst, se var inlägget är bredare och skär det</translation>
        </message>
        <message>
            <source>Choose “Section” to cut the insole anywhere and read its thickness.</source>
            <translation>Välj ”Snitt” för att skära inlägget var som helst och läsa av tjockleken.</translation>
        </message>
        <message>
            <source>Click on the foot to place it.</source>
            <translation>Klicka på foten för att placera det.</translation>
        </message>
        <message>
            <source>Click on the foot to put the reference plane through that place</source>
            <translation>Klicka på foten för att lägga referensplanet genom den punkten</translation>
        </message>
        <message>
            <source>Click on the sole to cut the insole there</source>
            <translation>Klicka på fotsulan för att snitta inlägget där</translation>
        </message>
        <message>
            <source>Click on the sole to place: {name}</source>
            <translation>Klicka på fotsulan för att placera: {name}</translation>
        </message>
        <message>
            <source>Click on the sole where it shall be. The example has one already: drag that one to another place.</source>
            <translation>Klicka på fotsulan där den ska sitta. Exemplet har redan en: dra den till ett annat ställe.</translation>
        </message>
        <message>
            <source>Click on the sole where the insole shall be cut, or drag the line to there.</source>
            <translation>Klicka på sulan där inlägget ska skäras, eller dra linjen dit.</translation>
        </message>
        <message>
            <source>Close Insole Studio</source>
            <translation>Stäng Insole Studio</translation>
        </message>
        <message>
            <source>Colour by height</source>
            <translation>Färglägg efter höjd</translation>
        </message>
        <message>
            <source>Colour by the distance of the insole from the foot</source>
            <translation>Färglägg efter inläggets avstånd från foten</translation>
        </message>
        <message>
            <source>Colour by thickness</source>
            <translation>Färglägg efter tjocklek</translation>
        </message>
        <message>
            <source>Colour maps, contour lines and wireframe</source>
            <translation>Färgkartor, höjdkurvor och trådmodell</translation>
        </message>
        <message>
            <source>Confirm landmarks</source>
            <translation>Bekräfta landmärken</translation>
        </message>
        <message>
            <source>Confirm the landmarks</source>
            <translation>Bekräfta landmärkena</translation>
        </message>
        <message>
            <source>Contact surface</source>
            <translation>Kontaktyta</translation>
        </message>
        <message>
            <source>Contour lines</source>
            <translation>Höjdkurvor</translation>
        </message>
        <message>
            <source>Copy</source>
            <translation>Kopiera</translation>
        </message>
        <message>
            <source>Copy the measures</source>
            <translation>Kopiera måtten</translation>
        </message>
        <message>
            <source>Cut the insole and measure its thickness</source>
            <translation>Snitta inlägget och mät dess tjocklek</translation>
        </message>
        <message>
            <source>Cut the insole where the pointer is, and show the heights there</source>
            <translation>Snitta inlägget där pekaren är, och visa höjderna där</translation>
        </message>
        <message>
            <source>Dark theme</source>
            <translation>Mörkt tema</translation>
        </message>
        <message>
            <source>Delete the photo</source>
            <translation>Ta bort fotot</translation>
        </message>
        <message>
            <source>Design</source>
            <translation>Design</translation>
        </message>
        <message>
            <source>Discard changes</source>
            <translation>Kasta ändringar</translation>
        </message>
        <message>
            <source>Discard it…</source>
            <translation>Kasta…</translation>
        </message>
        <message>
            <source>Do not open</source>
            <translation>Öppna inte</translation>
        </message>
        <message>
            <source>Do the last undone step again</source>
            <translation>Gör det senast ångrade steget igen</translation>
        </message>
        <message>
            <source>Done</source>
            <translation>Klart</translation>
        </message>
        <message>
            <source>Dorsal</source>
            <translation>Dorsalt</translation>
        </message>
        <message>
            <source>Drag a landmark to its place; a click marks a point, a double click writes on it</source>
            <translation>Dra ett landmärke på plats; klicka för att märka en punkt, dubbelklicka för att skriva på den</translation>
        </message>
        <message>
            <source>Drag a landmark to where it belongs. The insole follows at once, and Ctrl+Z takes it back. Skip this if all of them are right.</source>
            <translation>Dra ett landmärke dit det hör. Inlägget följer genast, och Ctrl+Z tar tillbaka det. Hoppa över detta om alla är rätt.</translation>
        </message>
        <message>
            <source>Drag heel or forefoot up to raise the medial edge, down to raise the lateral</source>
            <translation>Dra häl eller framfot uppåt för att höja den mediala kanten, nedåt för den laterala</translation>
        </message>
        <message>
            <source>Drag over the sole to lower the surface there</source>
            <translation>Dra över fotsulan för att sänka ytan där</translation>
        </message>
        <message>
            <source>Drag over the sole to raise the surface there</source>
            <translation>Dra över fotsulan för att höja ytan där</translation>
        </message>
        <message>
            <source>Drag over the sole to smooth the surface there</source>
            <translation>Dra över fotsulan för att jämna ut ytan där</translation>
        </message>
        <message>
            <source>Drag the middle to move the section, its end to turn it</source>
            <translation>Dra mitten för att flytta snittet, dess ände för att vrida det</translation>
        </message>
        <message>
            <source>Drag the middle up or down to raise the plane, its ends to turn it</source>
            <translation>Dra mitten upp eller ned för att höja planet, dess ändar för att vrida det</translation>
        </message>
        <message>
            <source>Drag to move the section</source>
            <translation>Dra för att flytta snittet</translation>
        </message>
        <message>
            <source>Drag to move, handles to stretch, turn and raise, wheel to raise by 0.5 mm</source>
            <translation>Dra för att flytta, handtag för att sträcka, vrida och höja, hjul höjer 0,5 mm</translation>
        </message>
        <message>
            <source>Drag to turn the section</source>
            <translation>Dra för att vrida snittet</translation>
        </message>
        <message>
            <source>Drag to turn, Shift and drag to move, wheel to zoom, double click to centre</source>
            <translation>Dra för att rotera, Skift och dra för att flytta, hjul för att zooma, dubbelklicka för att centrera</translation>
        </message>
        <message>
            <source>Drag up or down to raise or lower the plane</source>
            <translation>Dra upp eller ned för att höja eller sänka planet</translation>
        </message>
        <message>
            <source>Drag up or down to tilt the plane sideways</source>
            <translation>Dra upp eller ned för att luta planet i sidled</translation>
        </message>
        <message>
            <source>Drag up or down to tilt the toe end</source>
            <translation>Dra upp eller ned för att luta tåänden</translation>
        </message>
        <message>
            <source>Draw a pad</source>
            <translation>Rita en pelott</translation>
        </message>
        <message>
            <source>Draw the outline of a pad on the sole</source>
            <translation>Rita konturen av en pelott på fotsulan</translation>
        </message>
        <message>
            <source>Draw the outline of a pad round its place, in one go</source>
            <translation>Rita konturen av en pelott runt dess plats, i ett drag</translation>
        </message>
        <message>
            <source>Draw the outline of a usual shoe of this size, with the height of its heel</source>
            <translation>Rita konturen av en vanlig sko i denna storlek, med klackens höjd</translation>
        </message>
        <message>
            <source>Draw what rearfoot angle, Achilles to sole and Achilles lean are</source>
            <translation>Rita vad bakfotsvinkel, akilles mot fotsula och akilles lutning är</translation>
        </message>
        <message>
            <source>Draw with the processor, where the graphics card cannot; from the next start</source>
            <translation>Rita med processorn där grafikkortet inte kan; från nästa start</translation>
        </message>
        <message>
            <source>Edit the insole</source>
            <translation>Ändra inlägget</translation>
        </message>
        <message>
            <source>Edit the layers</source>
            <translation>Ändra lagren</translation>
        </message>
        <message>
            <source>Edit the outline</source>
            <translation>Ändra konturen</translation>
        </message>
        <message>
            <source>Edit the patient's fields</source>
            <translation>Ändra patientuppgifterna</translation>
        </message>
        <message>
            <source>Edit the posting</source>
            <translation>Ändra kilningen</translation>
        </message>
        <message>
            <source>Edit: {name}</source>
            <translation>Ändra: {name}</translation>
        </message>
        <message>
            <source>End the tour</source>
            <translation>Avsluta rundturen</translation>
        </message>
        <message>
            <source>Examine again</source>
            <translation>Undersök igen</translation>
        </message>
        <message>
            <source>Examine this computer</source>
            <translation>Undersök datorn</translation>
        </message>
        <message>
            <source>Examine this computer…</source>
            <translation>Undersök datorn…</translation>
        </message>
        <message>
            <source>Examining…</source>
            <translation>Undersöker…</translation>
        </message>
        <message>
            <source>Example, Anna</source>
            <translation>Exempel, Anna</translation>
        </message>
        <message>
            <source>Expert</source>
            <translation>Expert</translation>
        </message>
        <message>
            <source>Exported {name}</source>
            <translation>Exporterade {name}</translation>
        </message>
        <message>
            <source>Find landmarks anew</source>
            <translation>Sök landmärken på nytt</translation>
        </message>
        <message>
            <source>Find the landmarks anew</source>
            <translation>Sök landmärkena på nytt</translation>
        </message>
        <message>
            <source>Finish</source>
            <translation>Klart</translation>
        </message>
        <message>
            <source>Fit map</source>
            <translation>Passformskarta</translation>
        </message>
        <message>
            <source>Foot</source>
            <translation>Fot</translation>
        </message>
        <message>
            <source>Foot and insole turn together</source>
            <translation>Fot och inlägg roteras tillsammans</translation>
        </message>
        <message>
            <source>Foot in colour</source>
            <translation>Fot i färg</translation>
        </message>
        <message>
            <source>Forefoot angle</source>
            <translation>Framfotsvinkel</translation>
        </message>
        <message>
            <source>Forget the landmarks that were set by hand</source>
            <translation>Glöm landmärken som satts för hand</translation>
        </message>
        <message>
            <source>From a scan to the written file, on the example; again, to reach its bubble</source>
            <translation>Från skanning till skriven fil, på exemplet; igen för att nå dess bubbla</translation>
        </message>
        <message>
            <source>From the first to the last visit; ±: 95 % limits of a change</source>
            <translation>Från första till sista besöket; ±: 95 %-gränser för en ändring</translation>
        </message>
        <message>
            <source>Front edge {distance} mm ahead of the metatarsal heads</source>
            <translation>Framkanten {distance} mm framför metatarsalhuvudena</translation>
        </message>
        <message>
            <source>Front edge {distance} mm behind the metatarsal heads</source>
            <translation>Framkanten {distance} mm bakom metatarsalhuvudena</translation>
        </message>
        <message>
            <source>Go on working</source>
            <translation>Fortsätt arbeta</translation>
        </message>
        <message>
            <source>Graphics, sensors, disk, settings and record, with advice</source>
            <translation>Grafik, sensorer, disk, inställningar och journal, med råd</translation>
        </message>
        <message>
            <source>Grey difference: within the error</source>
            <translation>Grå skillnad: inom felet</translation>
        </message>
        <message>
            <source>Heel centre</source>
            <translation>Hälcentrum</translation>
        </message>
        <message>
            <source>Heel lift {mm:.1f} mm</source>
            <translation>Hälhöjning {mm:.1f} mm</translation>
        </message>
        <message>
            <source>Heel of the shoe {mm:.1f} mm</source>
            <translation>Skons klack {mm:.1f} mm</translation>
        </message>
        <message>
            <source>Heel width</source>
            <translation>Hälbredd</translation>
        </message>
        <message>
            <source>Height map</source>
            <translation>Höjdkarta</translation>
        </message>
        <message>
            <source>Held</source>
            <translation>Hålls</translation>
        </message>
        <message>
            <source>Here is the scanned foot; the landmarks on its skin were found. Choose “Landmarks” to see and correct them.</source>
            <translation>Här är den skannade foten; landmärkena på huden är hittade. Välj ”Landmärken” för att se och rätta dem.</translation>
        </message>
        <message>
            <source>How far the values of both feet may be off: 95 % limits</source>
            <translation>Hur långt fötternas värden kan ligga fel: 95 %-gränser</translation>
        </message>
        <message>
            <source>Identify</source>
            <translation>Visa vilken</translation>
        </message>
        <message>
            <source>Inches</source>
            <translation>Tum</translation>
        </message>
        <message>
            <source>Inside at the ball</source>
            <translation>Invändigt vid trampdynan</translation>
        </message>
        <message>
            <source>Insole Studio</source>
            <translation>Insole Studio</translation>
        </message>
        <message>
            <source>Insole Studio case</source>
            <translation>Insole Studio-fall</translation>
        </message>
        <message>
            <source>Insole Studio met an error of its own last time. A report of it is kept; it holds no patients' data.</source>
            <translation>Insole Studio råkade ut för ett eget fel förra gången. En rapport om det är sparad; den innehåller inga patientuppgifter.</translation>
        </message>
        <message>
            <source>Insole Studio was updated to version {version}.</source>
            <translation>Insole Studio har uppdaterats till version {version}.</translation>
        </message>
        <message>
            <source>Insole Studio: from the scan of a foot to its insole. BSD 3-Clause licence.</source>
            <translation>Insole Studio: från skanning av en fot till dess inlägg. BSD 3-Clause-licens.</translation>
        </message>
        <message>
            <source>Insole over foot</source>
            <translation>Inlägg över fot</translation>
        </message>
        <message>
            <source>Insole up to {mm:.1f} mm wider</source>
            <translation>Inlägget upp till {mm:.1f} mm bredare</translation>
        </message>
        <message>
            <source>Instep height</source>
            <translation>Vristhöjd</translation>
        </message>
        <message>
            <source>It holds the pads and corrections of the insole that it was kept from; those of this design come on top.</source>
            <translation>Den innehåller pelotterna och korrigeringarna från inlägget som den sparades från; de i den här designen läggs ovanpå.</translation>
        </message>
        <message>
            <source>Keep it</source>
            <translation>Behåll</translation>
        </message>
        <message>
            <source>Keep it open</source>
            <translation>Behåll öppet</translation>
        </message>
        <message>
            <source>Keep the photo</source>
            <translation>Behåll fotot</translation>
        </message>
        <message>
            <source>Keep, and capture the other foot</source>
            <translation>Behåll, och avbilda andra foten</translation>
        </message>
        <message>
            <source>L</source>
            <translation>V</translation>
        </message>
        <message>
            <source>LEFT</source>
            <translation>VÄNSTER</translation>
        </message>
        <message>
            <source>LEFT foot</source>
            <translation>VÄNSTER fot</translation>
        </message>
        <message>
            <source>Landmarks</source>
            <translation>Landmärken</translation>
        </message>
        <message>
            <source>Language of the system</source>
            <translation>Systemets språk</translation>
        </message>
        <message>
            <source>Large targets for fingers</source>
            <translation>Stora mål för fingrar</translation>
        </message>
        <message>
            <source>Last: {name}…</source>
            <translation>Läst: {name}…</translation>
        </message>
        <message>
            <source>Lateral</source>
            <translation>Lateralt</translation>
        </message>
        <message>
            <source>Left foot</source>
            <translation>Vänster fot</translation>
        </message>
        <message>
            <source>Let the light of this sensor blink</source>
            <translation>Låt denna sensors lampa blinka</translation>
        </message>
        <message>
            <source>Level</source>
            <translation>Räta upp</translation>
        </message>
        <message>
            <source>Level the sensor by its accelerometer</source>
            <translation>Räta upp sensorn med dess accelerometer</translation>
        </message>
        <message>
            <source>Licences</source>
            <translation>Licenser</translation>
        </message>
        <message>
            <source>Licences…</source>
            <translation>Licenser…</translation>
        </message>
        <message>
            <source>Light from the side</source>
            <translation>Släpljus</translation>
        </message>
        <message>
            <source>Light text on a dark ground</source>
            <translation>Ljus text på mörk botten</translation>
        </message>
        <message>
            <source>Light the insole from the side, so that bumps and hollows show</source>
            <translation>Belys inlägget från sidan, så att upphöjningar och gropar syns</translation>
        </message>
        <message>
            <source>Lines of equal height on the contact surface, a millimetre apart</source>
            <translation>Linjer med lika höjd på kontaktytan, en millimeter isär</translation>
        </message>
        <message>
            <source>Linked views</source>
            <translation>Länkade vyer</translation>
        </message>
        <message>
            <source>Look again</source>
            <translation>Titta igen</translation>
        </message>
        <message>
            <source>Look at it without changing its file, or go on with a copy under another name.</source>
            <translation>Titta på det utan att ändra filen, eller fortsätt med en kopia under ett annat namn.</translation>
        </message>
        <message>
            <source>Look at the report</source>
            <translation>Se rapporten</translation>
        </message>
        <message>
            <source>Look from here, in both views</source>
            <translation>Titta härifrån, i båda vyerna</translation>
        </message>
        <message>
            <source>Looking for sensors</source>
            <translation>Söker sensorer</translation>
        </message>
        <message>
            <source>Lower with the brush</source>
            <translation>Sänk med penseln</translation>
        </message>
        <message>
            <source>Make foot and insole of the side that was not scanned by mirroring; it is said</source>
            <translation>Gör fot och inlägg för sidan som inte skannades genom spegling; det sägs</translation>
        </message>
        <message>
            <source>Make no foot</source>
            <translation>Gör ingen fot</translation>
        </message>
        <message>
            <source>Make the left foot alone</source>
            <translation>Gör bara vänster fot</translation>
        </message>
        <message>
            <source>Make the right foot alone</source>
            <translation>Gör bara höger fot</translation>
        </message>
        <message>
            <source>Maps</source>
            <translation>Kartor</translation>
        </message>
        <message>
            <source>Mark a point</source>
            <translation>Märk en punkt</translation>
        </message>
        <message>
            <source>Measure along the surface and straight, on foot or insole</source>
            <translation>Mät längs ytan och rakt, på fot eller inlägg</translation>
        </message>
        <message>
            <source>Measuring tape</source>
            <translation>Måttband</translation>
        </message>
        <message>
            <source>Medial</source>
            <translation>Medialt</translation>
        </message>
        <message>
            <source>Metres</source>
            <translation>Meter</translation>
        </message>
        <message>
            <source>Millimetres</source>
            <translation>Millimeter</translation>
        </message>
        <message>
            <source>Mirror the left foot to the right</source>
            <translation>Spegla vänsterfoten till höger</translation>
        </message>
        <message>
            <source>Mirror the right foot to the left</source>
            <translation>Spegla högerfoten till vänster</translation>
        </message>
        <message>
            <source>Mondopoint</source>
            <translation>Mondopoint</translation>
        </message>
        <message>
            <source>Move down</source>
            <translation>Flytta ned</translation>
        </message>
        <message>
            <source>Move up</source>
            <translation>Flytta upp</translation>
        </message>
        <message>
            <source>Move: {name}</source>
            <translation>Flytta: {name}</translation>
        </message>
        <message>
            <source>Navicular height</source>
            <translation>Navikularhöjd</translation>
        </message>
        <message>
            <source>New case</source>
            <translation>Nytt fall</translation>
        </message>
        <message>
            <source>New here? The tour makes a whole insole of an example, from scan to file.</source>
            <translation>Ny här? Rundturen gör ett helt inlägg av ett exempel, från skanning till fil.</translation>
        </message>
        <message>
            <source>Next</source>
            <translation>Nästa</translation>
        </message>
        <message>
            <source>Next stroke</source>
            <translation>Nästa penseldrag</translation>
        </message>
        <message>
            <source>Next: {name}</source>
            <translation>Nästa: {name}</translation>
        </message>
        <message>
            <source>None of the sensors has a motor, which would tilt it between bursts</source>
            <translation>Ingen av sensorerna har en motor, som skulle luta den mellan serierna</translation>
        </message>
        <message>
            <source>None yet. Choose the pelott tool and click on the sole.</source>
            <translation>Inga än. Välj pelottverktyget och klicka på fotsulan.</translation>
        </message>
        <message>
            <source>Not now</source>
            <translation>Inte nu</translation>
        </message>
        <message>
            <source>Not weight-bearing</source>
            <translation>Utan belastning</translation>
        </message>
        <message>
            <source>Nothing is lost: the case stays open, and is not saved yet.</source>
            <translation>Inget har gått förlorat: fallet är fortfarande öppet men inte sparat än.</translation>
        </message>
        <message>
            <source>Nothing to drag here; the right button turns the view, and so does Orbit (O)</source>
            <translation>Här finns inget att dra; höger knapp roterar vyn, liksom Rotera (O)</translation>
        </message>
        <message>
            <source>Now a pad behind the metatarsal heads. Choose the tool “Pelott”.</source>
            <translation>Nu en pelott bakom metatarsalhuvudena. Välj verktyget ”Pelott”.</translation>
        </message>
        <message>
            <source>Of all that the program comes with</source>
            <translation>För allt som följer med programmet</translation>
        </message>
        <message>
            <source>One after the other</source>
            <translation>En efter en</translation>
        </message>
        <message>
            <source>Open a case that was saved</source>
            <translation>Öppna ett sparat fall</translation>
        </message>
        <message>
            <source>Open a copy</source>
            <translation>Öppna en kopia</translation>
        </message>
        <message>
            <source>Open anyway</source>
            <translation>Öppna ändå</translation>
        </message>
        <message>
            <source>Open case…</source>
            <translation>Öppna fall…</translation>
        </message>
        <message>
            <source>Open it</source>
            <translation>Öppna</translation>
        </message>
        <message>
            <source>Open it as a case</source>
            <translation>Öppna det som ett fall</translation>
        </message>
        <message>
            <source>Open read-only</source>
            <translation>Öppna skrivskyddat</translation>
        </message>
        <message>
            <source>Open recent</source>
            <translation>Öppna senaste</translation>
        </message>
        <message>
            <source>Open session</source>
            <translation>Öppna session</translation>
        </message>
        <message>
            <source>Open session…</source>
            <translation>Öppna session…</translation>
        </message>
        <message>
            <source>Open the case that comes with Insole Studio</source>
            <translation>Öppna fallet som följer med Insole Studio</translation>
        </message>
        <message>
            <source>Open the example</source>
            <translation>Öppna exemplet</translation>
        </message>
        <message>
            <source>Open the folder of a recorded session and reconstruct its foot</source>
            <translation>Öppna mappen med en inspelad session och rekonstruera foten</translation>
        </message>
        <message>
            <source>Open the scan of another program, or a recorded session in one file</source>
            <translation>Öppna en skanning från ett annat program, eller en inspelad session i en enda fil</translation>
        </message>
        <message>
            <source>Opening the case</source>
            <translation>Öppnar fallet</translation>
        </message>
        <message>
            <source>Orbit</source>
            <translation>Rotera</translation>
        </message>
        <message>
            <source>Other foot as mirror image</source>
            <translation>Andra foten som spegelbild</translation>
        </message>
        <message>
            <source>Outline of a shoe EU {size:g}</source>
            <translation>Kontur av en sko EU {size:g}</translation>
        </message>
        <message>
            <source>Outline of a shoe, its size a guess: the heel or the toes were not scanned</source>
            <translation>Kontur av en sko, storleken gissad: hälen eller tårna skannades inte</translation>
        </message>
        <message>
            <source>Parameters</source>
            <translation>Parametrar</translation>
        </message>
        <message>
            <source>Patient</source>
            <translation>Patient</translation>
        </message>
        <message>
            <source>Place a pelott</source>
            <translation>Placera en pelott</translation>
        </message>
        <message>
            <source>Place and shape pelotts</source>
            <translation>Placera och forma pelotter</translation>
        </message>
        <message>
            <source>Place the reference plane</source>
            <translation>Placera referensplanet</translation>
        </message>
        <message>
            <source>Place: {name}</source>
            <translation>Placera: {name}</translation>
        </message>
        <message>
            <source>Plantar</source>
            <translation>Plantart</translation>
        </message>
        <message>
            <source>Point at the insole or the foot to cut the insole there</source>
            <translation>Peka på inlägget eller foten för att snitta inlägget där</translation>
        </message>
        <message>
            <source>Point {number}</source>
            <translation>Punkt {number}</translation>
        </message>
        <message>
            <source>Posterior</source>
            <translation>Bakifrån</translation>
        </message>
        <message>
            <source>Prescribe on this scan what an earlier case prescribes</source>
            <translation>Ordinera på denna skanning det som ett tidigare fall ordinerar</translation>
        </message>
        <message>
            <source>Prescribe the height of the finished arch and its place</source>
            <translation>Ordinera det färdiga fotvalvets höjd och plats</translation>
        </message>
        <message>
            <source>Prescribe what a template holds; one of the other side is mirrored</source>
            <translation>Ordinera det som en mall innehåller; en mall för andra sidan speglas</translation>
        </message>
        <message>
            <source>Print outline 1:1…</source>
            <translation>Skriv ut kontur 1:1…</translation>
        </message>
        <message>
            <source>Print the measures…</source>
            <translation>Skriv ut måtten…</translation>
        </message>
        <message>
            <source>Put right the landmarks of the foot</source>
            <translation>Rätta till fotens landmärken</translation>
        </message>
        <message>
            <source>Put the table of measures onto the clipboard</source>
            <translation>Lägg tabellen med mått på urklipp</translation>
        </message>
        <message>
            <source>Quit</source>
            <translation>Avsluta</translation>
        </message>
        <message>
            <source>R</source>
            <translation>H</translation>
        </message>
        <message>
            <source>RIGHT</source>
            <translation>HÖGER</translation>
        </message>
        <message>
            <source>RIGHT foot</source>
            <translation>HÖGER fot</translation>
        </message>
        <message>
            <source>Raise with the brush</source>
            <translation>Höj med penseln</translation>
        </message>
        <message>
            <source>Raise, lower or smooth the surface with strokes</source>
            <translation>Höj, sänk eller jämna ut ytan med penseldrag</translation>
        </message>
        <message>
            <source>Reading…</source>
            <translation>Läser…</translation>
        </message>
        <message>
            <source>Rearfoot angle</source>
            <translation>Bakfotsvinkel</translation>
        </message>
        <message>
            <source>Rearmost point</source>
            <translation>Bakersta punkten</translation>
        </message>
        <message>
            <source>Redo</source>
            <translation>Gör om</translation>
        </message>
        <message>
            <source>Reference plane</source>
            <translation>Referensplan</translation>
        </message>
        <message>
            <source>Relief under a head</source>
            <translation>Avlastning under ett huvud</translation>
        </message>
        <message>
            <source>Relief under a toe</source>
            <translation>Avlastning under en tå</translation>
        </message>
        <message>
            <source>Remove</source>
            <translation>Ta bort</translation>
        </message>
        <message>
            <source>Remove a correction</source>
            <translation>Ta bort en korrigering</translation>
        </message>
        <message>
            <source>Remove correction</source>
            <translation>Ta bort korrigering</translation>
        </message>
        <message>
            <source>Remove the reference plane</source>
            <translation>Ta bort referensplanet</translation>
        </message>
        <message>
            <source>Renew the system, which brings the driver of the graphics card.</source>
            <translation>Förnya systemet, som har med grafikkortets drivrutin.</translation>
        </message>
        <message>
            <source>Repeat the design of a case…</source>
            <translation>Upprepa ett falls design…</translation>
        </message>
        <message>
            <source>Repeat the design of an earlier case</source>
            <translation>Upprepa designen från ett tidigare fall</translation>
        </message>
        <message>
            <source>Replace the file</source>
            <translation>Ersätt filen</translation>
        </message>
        <message>
            <source>Report of an error</source>
            <translation>Rapport om ett fel</translation>
        </message>
        <message>
            <source>Restart with software rendering</source>
            <translation>Starta om med programvarurendering</translation>
        </message>
        <message>
            <source>Right foot</source>
            <translation>Höger fot</translation>
        </message>
        <message>
            <source>Room that stays</source>
            <translation>Utrymme som lämnas</translation>
        </message>
        <message>
            <source>Save</source>
            <translation>Spara</translation>
        </message>
        <message>
            <source>Save as template…</source>
            <translation>Spara som mall…</translation>
        </message>
        <message>
            <source>Save as…</source>
            <translation>Spara som…</translation>
        </message>
        <message>
            <source>Save measures as CSV…</source>
            <translation>Spara mått som CSV…</translation>
        </message>
        <message>
            <source>Save the case</source>
            <translation>Spara fallet</translation>
        </message>
        <message>
            <source>Save the case under another name</source>
            <translation>Spara fallet under ett annat namn</translation>
        </message>
        <message>
            <source>Save the prescription without the patient, for other feet</source>
            <translation>Spara ordinationen utan patienten, för andra fötter</translation>
        </message>
        <message>
            <source>Save…</source>
            <translation>Spara…</translation>
        </message>
        <message>
            <source>Saving here would discard what was changed there.</source>
            <translation>Att spara här skulle kasta bort det som ändrats där.</translation>
        </message>
        <message>
            <source>Saving the case</source>
            <translation>Sparar fallet</translation>
        </message>
        <message>
            <source>Section</source>
            <translation>Snitt</translation>
        </message>
        <message>
            <source>Section follows the pointer</source>
            <translation>Snittet följer pekaren</translation>
        </message>
        <message>
            <source>Semi weight-bearing</source>
            <translation>Halv belastning</translation>
        </message>
        <message>
            <source>Sensor {serial}. Drag onto another to exchange views.</source>
            <translation>Sensor {serial}. Dra till en annan för att byta vyer.</translation>
        </message>
        <message>
            <source>Series a view, between which the motor tilts the sensor by a degree</source>
            <translation>Serier per vy, mellan vilka motorn lutar sensorn en grad</translation>
        </message>
        <message>
            <source>Session or mesh</source>
            <translation>Session eller ytmodell</translation>
        </message>
        <message>
            <source>Shaded</source>
            <translation>Skuggat</translation>
        </message>
        <message>
            <source>Shoe outline</source>
            <translation>Skokontur</translation>
        </message>
        <message>
            <source>Shoe size UK</source>
            <translation>Skostorlek UK</translation>
        </message>
        <message>
            <source>Shoe size US</source>
            <translation>Skostorlek US</translation>
        </message>
        <message>
            <source>Shoe…</source>
            <translation>Sko…</translation>
        </message>
        <message>
            <source>Show all</source>
            <translation>Visa allt</translation>
        </message>
        <message>
            <source>Show the edges of the insole's triangles alone</source>
            <translation>Visa bara kanterna av inläggets trianglar</translation>
        </message>
        <message>
            <source>Show the insole in its material</source>
            <translation>Visa inlägget i sitt material</translation>
        </message>
        <message>
            <source>Show the whole foot and the whole insole</source>
            <translation>Visa hela foten och hela inlägget</translation>
        </message>
        <message>
            <source>Sideways</source>
            <translation>Sidled</translation>
        </message>
        <message>
            <source>Signed in as {name}</source>
            <translation>Inloggad som {name}</translation>
        </message>
        <message>
            <source>Size</source>
            <translation>Storlek</translation>
        </message>
        <message>
            <source>Sizes</source>
            <translation>Storlekar</translation>
        </message>
        <message>
            <source>Skip</source>
            <translation>Hoppa över</translation>
        </message>
        <message>
            <source>Smooth with the brush</source>
            <translation>Jämna ut med penseln</translation>
        </message>
        <message>
            <source>Software rendering</source>
            <translation>Programvarurendering</translation>
        </message>
        <message>
            <source>Somebody holds the foot</source>
            <translation>Någon håller foten</translation>
        </message>
        <message>
            <source>Something unexpected happened; your work is kept. Please report it.</source>
            <translation>Något oväntat hände; ditt arbete finns kvar. Rapportera det gärna.</translation>
        </message>
        <message>
            <source>Start all the same</source>
            <translation>Starta ändå</translation>
        </message>
        <message>
            <source>Starting</source>
            <translation>Startar</translation>
        </message>
        <message>
            <source>Steps</source>
            <translation>Steg</translation>
        </message>
        <message>
            <source>Still missing: {names}</source>
            <translation>Saknas ännu: {names}</translation>
        </message>
        <message>
            <source>Surface</source>
            <translation>Yta</translation>
        </message>
        <message>
            <source>Switch a correction off</source>
            <translation>Slå av en korrigering</translation>
        </message>
        <message>
            <source>Switch a correction on</source>
            <translation>Slå på en korrigering</translation>
        </message>
        <message>
            <source>Switch on or off</source>
            <translation>Slå på eller av</translation>
        </message>
        <message>
            <source>Take a size of the library</source>
            <translation>Ta en storlek ur biblioteket</translation>
        </message>
        <message>
            <source>Take all landmarks as they are shown</source>
            <translation>Godta alla landmärken som de visas</translation>
        </message>
        <message>
            <source>Take the last step back</source>
            <translation>Ta tillbaka det senaste steget</translation>
        </message>
        <message>
            <source>Take the selected correction out of the design</source>
            <translation>Ta bort den valda korrigeringen ur designen</translation>
        </message>
        <message>
            <source>Take the tour</source>
            <translation>Ta rundturen</translation>
        </message>
        <message>
            <source>Tape</source>
            <translation>Måttband</translation>
        </message>
        <message>
            <source>Template of a prescription</source>
            <translation>Mall för ordination</translation>
        </message>
        <message>
            <source>Text of the point</source>
            <translation>Punktens text</translation>
        </message>
        <message>
            <source>That is the insole in the cut, the foot on it, and how thick it is where you point. The × of the panel closes it.</source>
            <translation>Så ser inlägget ut i snittet, med foten på, och hur tjockt det är där du pekar. Panelens × stänger den.</translation>
        </message>
        <message>
            <source>That outline crosses itself; draw it again in one round</source>
            <translation>Den konturen korsar sig själv; rita den igen i ett varv</translation>
        </message>
        <message>
            <source>That outline is too small for a pad; draw round its place</source>
            <translation>Den konturen är för liten för en pelott; rita runt dess plats</translation>
        </message>
        <message>
            <source>The 3-D views cannot be drawn: they need OpenGL {needed}, and this is {found}.</source>
            <translation>3D-vyerna kan inte ritas: de behöver OpenGL {needed}, och det här är {found}.</translation>
        </message>
        <message>
            <source>The 3-D views cannot be drawn: this computer has no OpenGL.</source>
            <translation>3D-vyerna kan inte ritas: den här datorn har ingen OpenGL.</translation>
        </message>
        <message>
            <source>The case has a left foot already; only one that was not scanned is mirrored.</source>
            <translation>Fallet har redan en vänsterfot; bara en som inte är skannad speglas.</translation>
        </message>
        <message>
            <source>The case has a right foot already; only one that was not scanned is mirrored.</source>
            <translation>Fallet har redan en högerfot; bara en som inte är skannad speglas.</translation>
        </message>
        <message>
            <source>The checks stand on the right, each with its number; a click shows the place. Click on “Export…” and say where to write the file.</source>
            <translation>Kontrollerna står till höger, var och en med sitt tal; ett klick visar stället. Klicka på ”Exportera…” och säg var filen ska skrivas.</translation>
        </message>
        <message>
            <source>The cut</source>
            <translation>Skärningen</translation>
        </message>
        <message>
            <source>The design</source>
            <translation>Designen</translation>
        </message>
        <message>
            <source>The file</source>
            <translation>Filen</translation>
        </message>
        <message>
            <source>The file is written: that was a whole insole. For a patient, begin with “New patient…” on the first page (F3); F1 explains what is in front of you.</source>
            <translation>Filen är skriven: det var ett helt inlägg. För en patient, börja med ”Ny patient…” på första sidan (F3); F1 förklarar det du har framför dig.</translation>
        </message>
        <message>
            <source>The foot</source>
            <translation>Foten</translation>
        </message>
        <message>
            <source>The graphics card draws from the next start on.</source>
            <translation>Grafikkortet ritar från nästa start.</translation>
        </message>
        <message>
            <source>The insole appears here as soon as there is a foot.</source>
            <translation>Inlägget visas här så snart det finns en fot.</translation>
        </message>
        <message>
            <source>The insole is being built…</source>
            <translation>Inlägget byggs…</translation>
        </message>
        <message>
            <source>The insole is designed. Click on “Check &amp; export” to check it for the shop.</source>
            <translation>Inlägget är designat. Klicka på ”Kontrollera &amp; exportera” för att kontrollera det för verkstaden.</translation>
        </message>
        <message>
            <source>The landmarks</source>
            <translation>Landmärkena</translation>
        </message>
        <message>
            <source>The language of the window, from the next start on</source>
            <translation>Fönstrets språk, från nästa start</translation>
        </message>
        <message>
            <source>The numbers</source>
            <translation>Siffrorna</translation>
        </message>
        <message>
            <source>The numbers of the design appear here.</source>
            <translation>Designens siffror visas här.</translation>
        </message>
        <message>
            <source>The page of the manual about what this version can do</source>
            <translation>Manualens sida om vad den här versionen kan</translation>
        </message>
        <message>
            <source>The patient whose visit was open was erased; the visit was closed.</source>
            <translation>Patienten vars besök var öppet har raderats; besöket stängdes.</translation>
        </message>
        <message>
            <source>The photo and its marks will be gone for good.</source>
            <translation>Fotot och dess märken försvinner för gott.</translation>
        </message>
        <message>
            <source>The processor cannot draw them either: renew the driver of the graphics card.</source>
            <translation>Processorn kan inte heller rita dem: förnya grafikkortets drivrutin.</translation>
        </message>
        <message>
            <source>The processor draws from the next start on.</source>
            <translation>Processorn ritar från nästa start.</translation>
        </message>
        <message>
            <source>The profile</source>
            <translation>Profilen</translation>
        </message>
        <message>
            <source>The program could not start itself; start it again.</source>
            <translation>Programmet kunde inte starta sig självt; starta det igen.</translation>
        </message>
        <message>
            <source>The program may end by itself as soon as it draws.</source>
            <translation>Programmet kan avslutas av sig självt så snart det ritar.</translation>
        </message>
        <message>
            <source>The report was removed by another window.</source>
            <translation>Rapporten togs bort av ett annat fönster.</translation>
        </message>
        <message>
            <source>The section</source>
            <translation>Snittet</translation>
        </message>
        <message>
            <source>The section lies beside the insole.</source>
            <translation>Snittet ligger bredvid inlägget.</translation>
        </message>
        <message>
            <source>The sensor stands</source>
            <translation>Sensorn står</translation>
        </message>
        <message>
            <source>The window speaks this language from the next start on.</source>
            <translation>Fönstret talar detta språk från nästa start.</translation>
        </message>
        <message>
            <source>There is unsaved work on this computer. It is kept, and offered as soon as somebody who treats patients has signed in.</source>
            <translation>På den här datorn finns arbete som inte är sparat. Det är bevarat och erbjuds så snart någon som behandlar patienter har loggat in.</translation>
        </message>
        <message>
            <source>Thickness map</source>
            <translation>Tjocklekskarta</translation>
        </message>
        <message>
            <source>This line is 100 mm long. If not, print without scaling.</source>
            <translation>Denna linje är 100 mm lång. Om inte: skriv ut utan skalning.</translation>
        </message>
        <message>
            <source>Tilt +</source>
            <translation>Luta +</translation>
        </message>
        <message>
            <source>Tilt the sensor down</source>
            <translation>Luta sensorn nedåt</translation>
        </message>
        <message>
            <source>Tilt the sensor up</source>
            <translation>Luta sensorn uppåt</translation>
        </message>
        <message>
            <source>Tilt −</source>
            <translation>Luta −</translation>
        </message>
        <message>
            <source>Tip of the 1st toe</source>
            <translation>Stortåns spets</translation>
        </message>
        <message>
            <source>Tip of the 2nd toe</source>
            <translation>Andra tåns spets</translation>
        </message>
        <message>
            <source>Toe end up</source>
            <translation>Tåänden upp</translation>
        </message>
        <message>
            <source>Toe filler</source>
            <translation>Tåutfyllnad</translation>
        </message>
        <message>
            <source>Tools</source>
            <translation>Verktyg</translation>
        </message>
        <message>
            <source>Touch mode</source>
            <translation>Pekläge</translation>
        </message>
        <message>
            <source>Tour</source>
            <translation>Rundtur</translation>
        </message>
        <message>
            <source>Trim the insole to the shoe</source>
            <translation>Skär inlägget efter skon</translation>
        </message>
        <message>
            <source>Turn a sensor from the box into a measuring device</source>
            <translation>Gör en sensor ur kartongen till ett mätinstrument</translation>
        </message>
        <message>
            <source>Turn the reference plane</source>
            <translation>Vrid referensplanet</translation>
        </message>
        <message>
            <source>Turn the view; click on a pelott to select it</source>
            <translation>Rotera vyn; klicka på en pelott för att välja den</translation>
        </message>
        <message>
            <source>Undo</source>
            <translation>Ångra</translation>
        </message>
        <message>
            <source>Unit of the file</source>
            <translation>Filens enhet</translation>
        </message>
        <message>
            <source>Use this scan</source>
            <translation>Använd denna skanning</translation>
        </message>
        <message>
            <source>Use this shoe</source>
            <translation>Använd skon</translation>
        </message>
        <message>
            <source>Version and licence</source>
            <translation>Version och licens</translation>
        </message>
        <message>
            <source>Version {version}</source>
            <translation>Version {version}</translation>
        </message>
        <message>
            <source>View of sensor {serial}</source>
            <translation>Vy för sensor {serial}</translation>
        </message>
        <message>
            <source>Weight-bearing</source>
            <translation>Belastad</translation>
        </message>
        <message>
            <source>What is new</source>
            <translation>Nyheter</translation>
        </message>
        <message>
            <source>What is selected, in mm and degrees. Give the pelott another height: click into its field and type it, or turn the wheel there.</source>
            <translation>Det valda, i mm och grader. Ge pelotten en annan höjd: klicka i fältet och skriv den, eller rulla med hjulet där.</translation>
        </message>
        <message>
            <source>What is to be seen here? The text stands at the point, in the record.</source>
            <translation>Vad syns här? Texten står vid punkten, i journalen.</translation>
        </message>
        <message>
            <source>What the angles are…</source>
            <translation>Vad vinklarna är…</translation>
        </message>
        <message>
            <source>What waited for the record cannot be stored: {reason} It is kept as {path}.</source>
            <translation>Det som väntade på journalen kan inte sparas: {reason} Det finns kvar som {path}.</translation>
        </message>
        <message>
            <source>What was recovered of {name} and not saved will be gone for good.</source>
            <translation>Det som räddats av {name} och inte sparats försvinner för alltid.</translation>
        </message>
        <message>
            <source>Wireframe</source>
            <translation>Trådmodell</translation>
        </message>
        <message>
            <source>With software rendering the processor draws them, more slowly. View ▸ Software rendering turns it off again once the graphics card has a newer driver.</source>
            <translation>Med programvarurendering ritar processorn dem, långsammare. Visa ▸ Programvarurendering stänger av det igen när grafikkortet fått en nyare drivrutin.</translation>
        </message>
        <message>
            <source>Write on a point</source>
            <translation>Skriv på en punkt</translation>
        </message>
        <message>
            <source>Write on it…</source>
            <translation>Skriv på den…</translation>
        </message>
        <message>
            <source>Write the measures with their ±, and a drawing of the angles, as PDF</source>
            <translation>Skriv måtten med deras ±, och en ritning av vinklarna, som PDF</translation>
        </message>
        <message>
            <source>Write the outline of the insole in true size as a PDF</source>
            <translation>Skriv inläggets kontur i naturlig storlek som PDF</translation>
        </message>
        <message>
            <source>Write the table of measures for a spreadsheet</source>
            <translation>Skriv tabellen med mått för ett kalkylblad</translation>
        </message>
        <message>
            <source>Written: {name}</source>
            <translation>Skrivet: {name}</translation>
        </message>
        <message>
            <source>YYYY-MM-DD</source>
            <translation>ÅÅÅÅ-MM-DD</translation>
        </message>
        <message>
            <source>any shoe</source>
            <translation>vilken sko som helst</translation>
        </message>
        <message>
            <source>by its last</source>
            <translation>efter läst</translation>
        </message>
        <message>
            <source>by its size</source>
            <translation>efter storlek</translation>
        </message>
        <message>
            <source>comes with the scan</source>
            <translation>kommer med skanningen</translation>
        </message>
        <message>
            <source>difference</source>
            <translation>skillnad</translation>
        </message>
        <message>
            <source>frames</source>
            <translation>bilder</translation>
        </message>
        <message>
            <source>lat.</source>
            <translation>lat.</translation>
        </message>
        <message>
            <source>markers {seen} of {wanted}</source>
            <translation>markörer {seen} av {wanted}</translation>
        </message>
        <message>
            <source>measured inside</source>
            <translation>mätt invändigt</translation>
        </message>
        <message>
            <source>med.</source>
            <translation>med.</translation>
        </message>
        <message>
            <source>mirrored from left</source>
            <translation>speglad från vänster</translation>
        </message>
        <message>
            <source>mirrored from right</source>
            <translation>speglad från höger</translation>
        </message>
        <message>
            <source>not measured</source>
            <translation>inte uppmätt</translation>
        </message>
        <message>
            <source>scan of {day}</source>
            <translation>skanning från {day}</translation>
        </message>
        <message>
            <source>template</source>
            <translation>mall</translation>
        </message>
        <message>
            <source>valg.</source>
            <translation>valg.</translation>
        </message>
        <message>
            <source>var.</source>
            <translation>var.</translation>
        </message>
        <message>
            <source>warm in {minutes:.0f} min</source>
            <translation>varm om {minutes:.0f} min</translation>
        </message>
        <message>
            <source>{change}: within the error</source>
            <translation>{change}: inom felet</translation>
        </message>
        <message>
            <source>{fps:.0f} frames/s, {lost} lost</source>
            <translation>{fps:.0f} bilder/s, {lost} förlorade</translation>
        </message>
        <message>
            <source>{name} (read-only)</source>
            <translation>{name} (skrivskyddat)</translation>
        </message>
        <message>
            <source>{name} has changes that are not saved.</source>
            <translation>{name} har ändringar som inte är sparade.</translation>
        </message>
        <message>
            <source>{name} was not saved either; it is kept as it was on {time}.</source>
            <translation>{name} var inte heller sparat; det är kvar som det var {time}.</translation>
        </message>
        <message>
            <source>{name} was not saved when Insole Studio ended last time. It is open again as it was on {time}.</source>
            <translation>{name} var inte sparat när Insole Studio senast avslutades. Det är öppet igen som det var {time}.</translation>
        </message>
        <message>
            <source>{name}: drag a handle to change it, drag beside it to turn the view</source>
            <translation>{name}: dra i ett handtag för att ändra, dra bredvid för att rotera vyn</translation>
        </message>
        <message>
            <source>{name}: what was changed on {time} is not in the record yet. It waits on this computer until the record takes it.</source>
            <translation>{name}: det som ändrades {time} finns inte i journalen ännu. Det väntar på den här datorn tills journalen tar emot det.</translation>
        </message>
        <message>
            <source>{name}: {sure} % sure. Drag to move it</source>
            <translation>{name}: {sure} % säker. Dra för att flytta</translation>
        </message>
        <message>
            <source>{seconds} s left</source>
            <translation>{seconds} s kvar</translation>
        </message>
        <message>
            <source>{share:.0%} measured</source>
            <translation>{share:.0%} uppmätt</translation>
        </message>
        <message>
            <source>{taken} of {wanted}</source>
            <translation>{taken} av {wanted}</translation>
        </message>
    </context>
</TS>

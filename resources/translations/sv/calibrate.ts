<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>insole_studio</name>
        <message>
            <source>Board</source>
            <translation>Bräde</translation>
        </message>
        <message>
            <source>Boards and marker templates at true size</source>
            <translation>Brädor och markörmallar i rätt storlek</translation>
        </message>
        <message>
            <source>Calibrate</source>
            <translation>Kalibrera</translation>
        </message>
        <message>
            <source>Calibrate sensors</source>
            <translation>Kalibrera sensorer</translation>
        </message>
        <message>
            <source>ChArUco board</source>
            <translation>ChArUco-bräde</translation>
        </message>
        <message>
            <source>Check the pattern by the newest wall</source>
            <translation>Pröva mönstret mot den senaste väggen</translation>
        </message>
        <message>
            <source>Chequerboard</source>
            <translation>Schackbräde</translation>
        </message>
        <message>
            <source>Choose folder…</source>
            <translation>Välj mapp…</translation>
        </message>
        <message>
            <source>Colour camera</source>
            <translation>Färgkamera</translation>
        </message>
        <message>
            <source>Comparing the wall with the pattern</source>
            <translation>Jämför väggen med mönstret</translation>
        </message>
        <message>
            <source>Cover the emitter, light the board well, and take 16 infrared pictures of it: turned by 20 to 40° to all sides, in all parts of the picture.</source>
            <translation>Täck projektorn, belys brädet väl och ta 16 infraröda bilder av det: vridet 20 till 40° åt alla håll, i alla delar av bilden.</translation>
        </message>
        <message>
            <source>Depth camera (infrared)</source>
            <translation>Djupkamera (infraröd)</translation>
        </message>
        <message>
            <source>Depth to colour</source>
            <translation>Djup till färg</translation>
        </message>
        <message>
            <source>Distortion of the depth</source>
            <translation>Djupets förvrängning</translation>
        </message>
        <message>
            <source>Do not save</source>
            <translation>Spara inte</translation>
        </message>
        <message>
            <source>Drop the result</source>
            <translation>Släng resultatet</translation>
        </message>
        <message>
            <source>Folder with the images</source>
            <translation>Mapp med bilderna</translation>
        </message>
        <message>
            <source>Give the serial number of the sensor, as it stands on its label.</source>
            <translation>Ange sensorns serienummer, som det står på dess etikett.</translation>
        </message>
        <message>
            <source>Inner corners</source>
            <translation>Inre hörn</translation>
        </message>
        <message>
            <source>It is still working; wait a moment.</source>
            <translation>Arbetet pågår; vänta ett ögonblick.</translation>
        </message>
        <message>
            <source>Keeping the picture</source>
            <translation>Sparar bilden</translation>
        </message>
        <message>
            <source>Let the sensor warm up for 15 minutes, point it at an empty flat wall that fills the picture, and take eight walls from 600 to 900 mm away, a little askew each time; depth and infrared are taken together. Later, one wall tells whether the pattern has drifted.</source>
            <translation>Låt sensorn värmas upp i 15 minuter, rikta den mot en tom plan vägg som fyller bilden, och ta åtta väggar på 600 till 900 mm, lite snett varje gång; djup och infrarött tas tillsammans. Senare säger en vägg om mönstret har glidit.</translation>
        </message>
        <message>
            <source>Let the sensor warm up for 15 minutes, point it at an empty flat wall, and capture ten frames at each of six distances from 500 to 1000 mm (with a RealSense at four from 400 to 700 mm), a little askew each time.</source>
            <translation>Låt sensorn värmas upp i 15 minuter, rikta den mot en tom plan vägg och ta tio bilder på vart och ett av sex avstånd från 500 till 1000 mm (med en RealSense på fyra från 400 till 700 mm), lite snett varje gång.</translation>
        </message>
        <message>
            <source>Live picture</source>
            <translation>Direktbild</translation>
        </message>
        <message>
            <source>Looking for sensors…</source>
            <translation>Söker efter sensorer…</translation>
        </message>
        <message>
            <source>Next: {step}.</source>
            <translation>Härnäst: {step}.</translation>
        </message>
        <message>
            <source>No pattern is kept to compare it with.</source>
            <translation>Det finns inget sparat mönster att jämföra med.</translation>
        </message>
        <message>
            <source>No picture yet: start the live picture, or choose a folder.</source>
            <translation>Ingen bild ännu: starta direktbilden, eller välj en mapp.</translation>
        </message>
        <message>
            <source>None of the pictures can be used yet.</source>
            <translation>Ingen av bilderna går att använda än.</translation>
        </message>
        <message>
            <source>Nothing is missing: calibrate.</source>
            <translation>Ingenting saknas: kalibrera.</translation>
        </message>
        <message>
            <source>Nothing was saved that can be undone.</source>
            <translation>Inget har sparats som kan ångras.</translation>
        </message>
        <message>
            <source>Paper</source>
            <translation>Papper</translation>
        </message>
        <message>
            <source>Pattern of dots (infrared)</source>
            <translation>Punktmönster (infrarött)</translation>
        </message>
        <message>
            <source>Print at 100 %, check the line at the edge, and glue the page to something stiff.</source>
            <translation>Skriv ut i 100 %, kontrollera linjen vid kanten och limma sidan på något styvt.</translation>
        </message>
        <message>
            <source>Print boards</source>
            <translation>Skriv ut brädor</translation>
        </message>
        <message>
            <source>Print boards…</source>
            <translation>Skriv ut brädor…</translation>
        </message>
        <message>
            <source>Print calibration boards…</source>
            <translation>Skriv ut kalibreringsbrädor…</translation>
        </message>
        <message>
            <source>Print the chequerboard at 100 %, glue it to something stiff, and take 15 colour pictures of it: tilted by 20 to 40° to all sides, in all parts of the picture.</source>
            <translation>Skriv ut schackbrädet i 100 %, limma det på något styvt och ta 15 färgbilder av det: lutat 20 till 40° åt alla håll, i alla delar av bilden.</translation>
        </message>
        <message>
            <source>Print…</source>
            <translation>Skriv ut…</translation>
        </message>
        <message>
            <source>Save anyway</source>
            <translation>Spara ändå</translation>
        </message>
        <message>
            <source>Save as PDF…</source>
            <translation>Spara som PDF…</translation>
        </message>
        <message>
            <source>Save it, if this is what you expect.</source>
            <translation>Spara det, om det är vad du väntar dig.</translation>
        </message>
        <message>
            <source>Save to the device</source>
            <translation>Spara för sensorn</translation>
        </message>
        <message>
            <source>Saved: {path}</source>
            <translation>Sparad: {path}</translation>
        </message>
        <message>
            <source>Sensor</source>
            <translation>Sensor</translation>
        </message>
        <message>
            <source>Sensor {serial} is as it was before the last change.</source>
            <translation>Sensor {serial} är som den var före den senaste ändringen.</translation>
        </message>
        <message>
            <source>Sensor {serial} is not connected.</source>
            <translation>Sensor {serial} är inte ansluten.</translation>
        </message>
        <message>
            <source>Serial number</source>
            <translation>Serienummer</translation>
        </message>
        <message>
            <source>Side of a square</source>
            <translation>En rutas sida</translation>
        </message>
        <message>
            <source>Start the live picture, or choose the folder with these images.</source>
            <translation>Starta direktbilden, eller välj mappen med dessa bilder.</translation>
        </message>
        <message>
            <source>Take by itself</source>
            <translation>Ta av sig själv</translation>
        </message>
        <message>
            <source>Take picture</source>
            <translation>Ta bild</translation>
        </message>
        <message>
            <source>Take pictures, or choose the folder with these images.</source>
            <translation>Ta bilder, eller välj mappen med dessa bilder.</translation>
        </message>
        <message>
            <source>Taking the picture: hold still.</source>
            <translation>Bilden tas: håll stilla.</translation>
        </message>
        <message>
            <source>Templates of the marker faces</source>
            <translation>Mallar för markörsidorna</translation>
        </message>
        <message>
            <source>The live picture</source>
            <translation>Direktbilden</translation>
        </message>
        <message>
            <source>The result of the step {step} is not saved.</source>
            <translation>Resultatet av steget {step} är inte sparat.</translation>
        </message>
        <message>
            <source>The sensor as it was before a result was last saved; again, to redo it</source>
            <translation>Sensorn som den var innan ett resultat senast sparades; en gång till för att göra om det</translation>
        </message>
        <message>
            <source>The sensor is calibrated.</source>
            <translation>Sensorn är kalibrerad.</translation>
        </message>
        <message>
            <source>The sensor is not plugged in.</source>
            <translation>Sensorn är inte ansluten.</translation>
        </message>
        <message>
            <source>There is no result to save yet.</source>
            <translation>Det finns inget resultat att spara än.</translation>
        </message>
        <message>
            <source>Turn the board strongly, by 40 to 55°, in turn to the left, to the right, upwards and downwards, 600 to 900 mm away and in all parts of the picture: 12 positions to each side in colour and depth, or 4 to each side in colour and infrared (emitter covered).</source>
            <translation>Vrid brädet kraftigt, 40 till 55°, i tur och ordning åt vänster, åt höger, uppåt och nedåt, 600 till 900 mm bort och i alla delar av bilden: 12 lägen åt varje håll i färg och djup, eller 4 åt varje håll i färg och infrarött (täckt projektor).</translation>
        </message>
        <message>
            <source>Undo the last step</source>
            <translation>Ångra senaste steget</translation>
        </message>
        <message>
            <source>Waiting for the first picture.</source>
            <translation>Väntar på den första bilden.</translation>
        </message>
        <message>
            <source>When the board or the wall stands still in a new place</source>
            <translation>När brädet eller väggen står stilla på ett nytt ställe</translation>
        </message>
        <message>
            <source>Whether the pattern that is kept has drifted; nothing is written</source>
            <translation>Om det sparade mönstret har glidit; ingenting skrivs</translation>
        </message>
        <message>
            <source>Writing the calibration and its reports</source>
            <translation>Skriver kalibreringen och dess rapporter</translation>
        </message>
        <message>
            <source>done on {day}</source>
            <translation>gjort {day}</translation>
        </message>
        <message>
            <source>optional</source>
            <translation>valfri</translation>
        </message>
        <message>
            <source>to do</source>
            <translation>att göra</translation>
        </message>
        <message>
            <source>{step} is saved for sensor {serial}.</source>
            <translation>{step} är sparad för sensor {serial}.</translation>
        </message>
        <message>
            <source>{usable} of {count} can be used.</source>
            <translation>{usable} av {count} kan användas.</translation>
        </message>
    </context>
</TS>

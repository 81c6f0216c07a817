<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv_SE" sourcelanguage="en">
    <context>
        <name>studio</name>
        <message>
            <source>Copy</source>
            <translation>Kopiera</translation>
        </message>
        <message>
            <source>Copy: {name}</source>
            <translation>Kopiera: {name}</translation>
        </message>
        <message>
            <source>Free-hand</source>
            <translation>Frihand</translation>
        </message>
        <message>
            <source>Plane</source>
            <translation>Plan</translation>
        </message>
        <message>
            <source>Size</source>
            <translation>Storlek</translation>
        </message>
    </context>
</TS>

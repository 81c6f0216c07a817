<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="sv">
    <context>
        <name>studio</name>
        <message>
            <source>Choose in the calendar (F4)</source>
            <translation>Välj i kalendern (F4)</translation>
        </message>
    </context>
</TS>

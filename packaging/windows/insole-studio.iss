; Inno Setup 6: the installer for Windows, for one user, without administrator rights.
; packaging/build.py calls it: iscc /DAppVersion=1.2.0 /Odist insole-studio.iss
#define AppName "Insole Studio"
#define Command "insole-studio"
#define Frozen "..\..\dist\insole-studio"

[Setup]
AppId={{7D7C5C0E-6B0E-4E52-9C8C-1C6B0E5A4F21}
AppName={#AppName}
AppVersion={#AppVersion}
AppPublisher=Insole Studio maintainers
AppPublisherURL=https://insole-studio.org
DefaultDirName={localappdata}\Programs\{#AppName}
DefaultGroupName={#AppName}
DisableProgramGroupPage=yes
PrivilegesRequired=lowest
ArchitecturesAllowed=x64compatible
ArchitecturesInstallIn64BitMode=x64compatible
OutputBaseFilename={#Command}-{#AppVersion}-setup
LicenseFile=..\..\LICENSE
UninstallDisplayIcon={app}\{#AppName}.exe
Compression=lzma2/max
SolidCompression=yes
ChangesAssociations=yes
WizardStyle=modern
; Signs the installer where the tool is configured: iscc /Ssigntool="signtool sign ... $f"
#ifdef SignWith
SignTool={#SignWith}
#endif

[Languages]
Name: "en"; MessagesFile: "compiler:Default.isl"
Name: "sv"; MessagesFile: "compiler:Languages\Swedish.isl"

[Files]
Source: "{#Frozen}\*"; DestDir: "{app}"; Flags: recursesubdirs createallsubdirs ignoreversion
Source: "kinect-v1.inf"; DestDir: "{app}\driver"; Flags: ignoreversion
Source: "kinect-v1.cat"; DestDir: "{app}\driver"; Flags: ignoreversion skipifsourcedoesntexist
Source: "DRIVER.txt"; DestDir: "{app}\driver"; Flags: ignoreversion

[InstallDelete]
; Files of an older version must not be loaded by this one. Patients lie elsewhere.
Type: filesandordirs; Name: "{app}\_internal"

[Icons]
Name: "{group}\{#AppName}"; Filename: "{app}\{#AppName}.exe"

[Registry]
Root: HKA; Subkey: "Software\Classes\.insole"; ValueType: string; ValueData: "InsoleStudio.Case"; Flags: uninsdeletevalue
Root: HKA; Subkey: "Software\Classes\.insole"; ValueType: string; ValueName: "Content Type"; ValueData: "application/x-insole-studio-case"
Root: HKA; Subkey: "Software\Classes\InsoleStudio.Case"; ValueType: string; ValueData: "Insole case"; Flags: uninsdeletekey
Root: HKA; Subkey: "Software\Classes\InsoleStudio.Case\DefaultIcon"; ValueType: string; ValueData: "{app}\{#AppName}.exe,0"
Root: HKA; Subkey: "Software\Classes\InsoleStudio.Case\shell\open\command"; ValueType: string; ValueData: """{app}\{#AppName}.exe"" open ""%1"""
Root: HKA; Subkey: "Software\Microsoft\Windows\CurrentVersion\App Paths\{#Command}.exe"; ValueType: string; ValueData: "{app}\{#Command}.exe"; Flags: uninsdeletekey

[Tasks]
Name: "driver"; Description: "Install the driver of Kinect v1 sensors (asks for an administrator)"; Flags: unchecked; Check: DriverIsSigned

[Run]
Filename: "pnputil.exe"; Parameters: "/add-driver ""{app}\driver\kinect-v1.inf"" /install"; Verb: runas; Flags: shellexec waituntilterminated runhidden; Tasks: driver
Filename: "{app}\{#AppName}.exe"; Description: "{cm:LaunchProgram,{#AppName}}"; Flags: nowait postinstall skipifsilent

[Code]
function DriverIsSigned(): Boolean;
begin
  // Windows takes no driver without a signed catalogue; see DRIVER.txt for the way by hand.
  Result := {#FileExists(AddBackslash(SourcePath) + "kinect-v1.cat") ? "True" : "False"};
end;

#!/usr/bin/env bash
# Sign the application, make the disk image, have Apple notarise it.
# Usage: sign-and-pack.sh APPLICATION IMAGE
# CODESIGN_IDENTITY   "Developer ID Application: …"; without it the signature is ad hoc, and whoever
#                     opens the application the first time has to allow it in the system's settings
# NOTARY_PROFILE      name under which `xcrun notarytool store-credentials` keeps the account
set -euo pipefail
application=$1 image=$2
identity=${CODESIGN_IDENTITY:--}
options=(--force --sign "$identity")
[ "$identity" = - ] || options+=(--timestamp --options runtime)
entitlements=$(dirname "$0")/entitlements.plist

# From the inside out: `codesign --deep` misses libraries in folders that are no frameworks, such as
# Qt's plugins, and Apple refuses the application for them.
find "$application/Contents" -type f -print0 | while IFS= read -r -d '' file; do
    case $(file -b "$file") in
    Mach-O*) codesign "${options[@]}" "$file" ;;
    esac
done
codesign "${options[@]}" --entitlements "$entitlements" "$application"
codesign --verify --strict --deep "$application"

staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
cp -R "$application" "$staging/"
ln -s /Applications "$staging/Applications"
rm -f "$image"
hdiutil create -volname "Insole Studio" -srcfolder "$staging" -format ULFO -fs HFS+ "$image"

if [ "$identity" != - ]; then
    codesign --force --timestamp --sign "$identity" "$image"
    if [ -n "${NOTARY_PROFILE:-}" ]; then
        xcrun notarytool submit "$image" --keychain-profile "$NOTARY_PROFILE" --wait
        xcrun stapler staple "$image"
    fi
fi

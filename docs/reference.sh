#!/bin/sh
# Writes docs/src/reference.md from what the program says of itself. Run it by hand, in the
# folder of the repository, after parameters have changed: sh docs/reference.sh
set -eu
landform=${LANDFORM:-target/release/landform}
page=docs/src/reference.md
{
    echo "# Reference: every name"
    echo
    echo "What \`landform describe\` says of every name that a scenario may hold."
    echo "This page is written by \`docs/reference.sh\`, run by hand: \`cargo build --release && sh docs/reference.sh\`."
    echo
    echo "| name | what it is |"
    echo "|---|---|"
    "$landform" list | sed -n 's/^  \([A-Za-z0-9]*\)  *\(.*\)$/\1\t\2/p' |
        while IFS="$(printf '\t')" read -r name text; do
            anchor=$(printf '%s' "$name" | tr '[:upper:]' '[:lower:]')
            printf '| [%s](#%s) | %s |\n' "$name" "$anchor" "$text"
        done
    "$landform" list | while read -r line; do
        case $line in
        "domains" | "initial conditions" | "processes" | "metrics" | "outputs")
            first=$(printf '%s' "$line" | cut -c1 | tr '[:lower:]' '[:upper:]')
            printf '\n## %s%s\n' "$first" "$(printf '%s' "$line" | cut -c2-)"
            ;;
        *)
            name=${line%% *}
            printf '\n### %s\n\n```text\n' "$name"
            "$landform" describe "$name"
            printf '```\n'
            ;;
        esac
    done
} >"$page.tmp"
mv "$page.tmp" "$page"

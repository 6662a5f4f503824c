#!/bin/sh
# Writes docs/src/results.md from what `landform reproduce --all -o FOLDER` left in a folder. Run it by
# hand, in the folder of the repository: sh docs/results.sh FOLDER
set -eu
page=docs/src/results.md
{
    echo "# Results"
    echo
    echo "Every number that \`landform reproduce --all\` compares, as it left them."
    echo "[Reproduce the thesis](reproduce.md) says how to read them, and what was found where one falls short."
    echo "This page is written by \`docs/results.sh\`, and a test checks that no number is missing."
    echo
    cat "$1/report.md"
} >"$page.tmp"
mv "$page.tmp" "$page"

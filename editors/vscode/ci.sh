#!/usr/bin/env bash
# The extension for Visual Studio Code: types, bundle, and the grammar over every scene of the repository.
# Needs node 20 or later and npm's registry.
set -euo pipefail
cd "$(dirname "$0")"

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "editors/vscode: skipped, there is no node here"
    exit 0
fi
npm ci --no-audit --no-fund --loglevel=error
npm test

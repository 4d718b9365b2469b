#!/usr/bin/env bash
# Draws the models that differ from a commit, and says in outputs and summary which they are.
#
# In:  MODELS_BASE, MODELS_PATTERNS, MODELS_SIZE, MODELS_FOLDER, MODELS_PYTHON, and what GitHub sets:
#      GITHUB_ACTION_PATH, GITHUB_OUTPUT, GITHUB_STEP_SUMMARY. Out: the folder; `changed` and `broken`;
#      a table in the summary.
set -euo pipefail
python=${MODELS_PYTHON:-python} base=${MODELS_BASE:-}
if [[ $base =~ ^0*$ ]]; then  # of a push that creates a branch, or of an event without a commit before
    base=origin/HEAD
    echo "models: no commit came before; compared with the default branch" >&2
fi

# Prints the commit that a name or a hash stands for. A checkout holds one commit, unless it was asked
# for more; others are fetched, which must not cut off a history that is there whole.
commit_of() {
    local depth= branch=${1#origin/}
    [[ $1 != -* && $branch != -* ]] || return 1
    git rev-parse --quiet --verify "$1^{commit}" && return
    git check-ref-format --allow-onelevel "$1" || return 1
    [ "$(git rev-parse --is-shallow-repository)" = false ] || depth=--depth=1
    git fetch --quiet --no-tags $depth origin "$branch" && git rev-parse --verify "FETCH_HEAD^{commit}"
}
commit=$(commit_of "$base") || { echo "models: no commit to compare with: '$base'" >&2; exit 2; }

before=$(mktemp -d)
trap 'git worktree remove --force "$before/tree" 2>/dev/null; rm -rf "$before"' EXIT
git worktree add --quiet --detach "$before/tree" "$commit"

"$python" "$GITHUB_ACTION_PATH/models.py" --before "$before/tree" --base "$commit" --size "${MODELS_SIZE:-480x360}" \
    --folder "${MODELS_FOLDER:-model-diff}" --summary "$GITHUB_STEP_SUMMARY" --patterns="${MODELS_PATTERNS:-}" >>"$GITHUB_OUTPUT"

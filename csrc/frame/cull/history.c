/* cull, over time: clusters that the view's last frame showed are drawn first, since they hide most of the others. The picture
 * does not depend on this. */
#include <string.h>

#include "frame/cull/history.h"

/* ---- the views of a renderer ---- */

static void free_history(e3d_history *history)
{
    e3d_array *arrays[] = {&history->rows, &history->rows_before, &history->seen, &history->seen_before};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        e3d_array_free(arrays[i]);
}

void e3d_histories_free(e3d_histories *histories)
{
    for (int h = 0; h < E3D_HISTORIES; h++)
        free_history(&histories->of[h]);
}

/* Copies an array; where memory is out, the copy stays empty. */
static void copy_array(e3d_array *to, const e3d_array *from, size_t size)
{
    to->count = 0;
    if (from->count && e3d_array_reserve(to, from->count, size)) {
        memcpy(to->data, from->data, from->count * size);
        to->count = from->count;
    }
}

static void begin_with(e3d_history *history, const e3d_history *other)
{
    copy_array(&history->rows, &other->rows, sizeof(e3d_history_row));
    copy_array(&history->seen, &other->seen, 1);
    if (history->seen.count != other->seen.count)
        history->rows.count = 0;
    history->trials = other->trials;
    history->remembers = other->remembers;
    history->doubts = other->doubts;
    history->backoff = other->backoff;
    history->tiles_changed = other->tiles_changed;
}

/* Forgets what was seen: what one light or eye sees says nothing of what another light sees. */
static void forget(e3d_history *history)
{
    const e3d_history nothing = {0};
    begin_with(history, &nothing);
}

e3d_history *e3d_history_of(e3d_histories *histories, const e3d_frame *frame)
{
    e3d_history *latest = NULL, *longest = histories->of, *found = NULL;
    for (e3d_history *h = histories->of; h < histories->of + E3D_HISTORIES; h++) {
        if (h->used && h->view == frame->view)
            found = h;
        if (h->used && !h->is_of_light && (!latest || h->used > latest->used))
            latest = h;
        longest = h->used < longest->used ? h : longest;
    }
    if (!found) {
        found = longest;
        if (!latest || frame->faces_only)
            forget(found);
        else if (found != latest)
            begin_with(found, latest);
        found->view = frame->view;
        found->is_of_light = frame->faces_only != 0;
    }
    found->used = ++histories->frames;
    return found;
}

/* ---- what the last frame showed ---- */

static e3d_history_row row_of(const e3d_draws *draws, const e3d_order_entry *entry)
{
    const e3d_draw_state *state = &draws->states[entry->draw];
    const e3d_draw *draw = state->draw;
    int32_t groups = state->mesh->group_count, node = e3d_object_id(draw, entry->instance);
    int64_t base = state->group_base + (int64_t)entry->instance * groups;
    if (draw->pose_kind == E3D_POSE_NODES)
        return (e3d_history_row){state->mesh->like, base, node, 0, 1, groups};
    return (e3d_history_row){state->mesh->like, base, node, draw->first_instance, draw->instances, groups};
}

/* Copies what the last frame knows of one draw's instances that this frame draws, too. Returns the number of groups. */
static int64_t take_over(const e3d_history_row *from, const uint8_t *old, const e3d_history_row *to, uint8_t *seen)
{
    int32_t first = from->first > to->first ? from->first : to->first;
    int32_t from_end = from->first + from->instances, to_end = to->first + to->instances;
    int32_t end = from_end < to_end ? from_end : to_end;
    if (from->mesh != to->mesh || from->groups != to->groups || first >= end)
        return 0;
    int64_t count = (int64_t)(end - first) * to->groups;
    memcpy(seen + to->base + (int64_t)(first - to->first) * to->groups,
           old + from->base + (int64_t)(first - from->first) * to->groups, (size_t)count);
    return count;
}

/* Merges two lists of rows, both sorted by node and then by instance. */
static int64_t match_rows(e3d_history *history)
{
    const e3d_history_row *old = history->rows_before.data, *rows = history->rows.data;
    size_t old_count = history->rows_before.count, at = 0;
    int64_t known = 0;
    for (size_t d = 0; d < history->rows.count; d++) {
        while (at < old_count && (old[at].node < rows[d].node ||
                                  (old[at].node == rows[d].node && old[at].first + old[at].instances <= rows[d].first)))
            at++;
        for (size_t j = at; j < old_count && old[j].node == rows[d].node &&
                            old[j].first < rows[d].first + rows[d].instances;
             j++)
            known += take_over(&old[j], history->seen_before.data, &rows[d], history->seen.data);
    }
    return known;
}

int e3d_history_remember(e3d_history *history, const e3d_draws *draws)
{
    size_t count = (size_t)draws->order_count, groups = (size_t)draws->groups;
    e3d_array_swap(&history->rows, &history->rows_before);
    e3d_array_swap(&history->seen, &history->seen_before);
    history->trials++;
    history->rows.count = 0; /* until it is whole */
    if (!e3d_array_reserve(&history->rows, count + 1, sizeof(e3d_history_row)) ||
        !e3d_array_reserve(&history->seen, groups + 1, 1))
        return -1;
    e3d_history_row *rows = history->rows.data;
    for (size_t d = 0; d < count; d++)
        rows[d] = row_of(draws, &draws->order[d]);
    memset(history->seen.data, 0, groups);
    history->rows.count = count;
    history->seen.count = groups;
    history->doubts = !history->remembers;
    history->remembers = 2 * match_rows(history) > draws->groups;
    return history->remembers;
}

/* ---- whether rounds pay ---- */

/* If little is hidden, rounds are tried again about once a second at 60 frames a second. */
enum { FRAMES_BETWEEN_TRIALS = 64 };

int e3d_history_backs_off(e3d_history *history, int64_t covered, int64_t candidates)
{
    e3d_backoff *backoff = &history->backoff;
    if (backoff->frames_left > 0 && 2 * covered <= 3 * backoff->covered && 2 * candidates <= 3 * backoff->candidates) {
        backoff->frames_left--;
        history->rows.count = 0; /* the scene will have changed when the next trial comes */
        return 1;
    }
    backoff->covered = covered;
    backoff->candidates = candidates;
    return 0;
}

/* Counts the clusters that showed when they were last tested. */
static int64_t count_seen(const e3d_history *history)
{
    const uint8_t *seen = history->seen.data;
    int64_t count = 0;
    for (size_t group = 0; group < history->seen.count; group++)
        count += __builtin_popcount(seen[group]);
    return count;
}

/* Whether few of the tested clusters are hidden. Testing boxes costs about as much as drawing a third of the clusters, and
 * keeping a tile as much as drawing one (measured). A frame that remembers nothing draws much before it knows what hides it; the
 * next frame tests all of that, and decides. */
static int hides_little(const e3d_history *history, const e3d_stats *stats)
{
    if (!history->remembers)
        return 0;
    int64_t tried = stats->clusters_drawn + stats->clusters_occluded, hidden = tried - count_seen(history);
    return 10 * (hidden - stats->tiles) < 3 * tried;
}

void e3d_history_judge(e3d_history *history, const e3d_stats *stats)
{
    history->backoff.frames_left = hides_little(history, stats) ? FRAMES_BETWEEN_TRIALS : 0;
}

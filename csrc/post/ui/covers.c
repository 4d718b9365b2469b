/* Covers: a user interface draws windows over backgrounds over backgrounds, of which only the last ones need to be drawn.
 * In: the large opaque rectangles of a list; then boxes. Out: the parts of a box that stay visible.
 * Always: the picture's pixels are the same as without covers. */
#include "post/ui/covers.h"

void ui_covers_add(ui_covers *covers, ui_box box, uint64_t order)
{
    if (covers->count < UI_MOST_COVERS && ui_pixels_of(box) >= UI_LEAST_COVER)
        covers->covers[covers->count++] = (ui_cover){box, order};
}

static int overlap(const ui_box *a, const ui_box *b)
{
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

typedef struct ui_search {
    const ui_covers *covers;
    uint64_t order;
    void (*draw)(const void *what, ui_box part);
    const void *what;
} ui_search;

/* Draws the visible parts of a box, where covers before number `from` hide nothing of it. */
static void draw_around(const ui_search *search, ui_box box, int from)
{
    if (ui_is_empty(box))
        return;
    const ui_cover *covers = search->covers->covers;
    while (from < search->covers->count && (covers[from].order <= search->order || !overlap(&box, &covers[from].box)))
        from++;
    if (from == search->covers->count) {
        search->draw(search->what, box);
        return;
    }
    ui_box hole = covers[from].box, above = box, below = box, left = box, right = box;
    left.top = right.top = above.bottom = hole.top > box.top ? hole.top : box.top;
    left.bottom = right.bottom = below.top = hole.bottom < box.bottom ? hole.bottom : box.bottom;
    left.right = hole.left;
    right.left = hole.right;
    draw_around(search, above, from + 1);
    draw_around(search, left, from + 1);
    draw_around(search, right, from + 1);
    draw_around(search, below, from + 1);
}

void ui_covers_around(const ui_covers *covers, ui_box box, uint64_t order, void (*draw)(const void *what, ui_box part),
                      const void *what)
{
    const ui_search search = {covers, order, draw, what};
    draw_around(&search, box, 0);
}

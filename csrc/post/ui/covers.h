/* Opaque rectangles, which hide everything that was drawn before them. Private to csrc/post/ui. */
#pragma once

#include "post/ui/setup.h"

enum {
    UI_MOST_COVERS = 32,
    UI_LEAST_COVER = 4096 /* pixels: smaller covers take longer to test than they save */
};

typedef struct ui_cover {
    ui_box box;
    uint64_t order; /* the order of drawing: a cover hides shapes of smaller order */
} ui_cover;

typedef struct ui_covers {
    int count;
    ui_cover covers[UI_MOST_COVERS];
} ui_covers;

static inline int ui_is_empty(ui_box box) { return box.left >= box.right || box.top >= box.bottom; }
static inline int64_t ui_pixels_of(ui_box box)
{
    return ui_is_empty(box) ? 0 : (int64_t)(box.right - box.left) * (box.bottom - box.top);
}

/* Adds an opaque rectangle, if it is large and there is room. Orders only grow. */
void ui_covers_add(ui_covers *covers, ui_box box, uint64_t order);

/* Calls draw(what, part) for the parts of a box that no later cover hides; they don't overlap. */
void ui_covers_around(const ui_covers *covers, ui_box box, uint64_t order, void (*draw)(const void *what, ui_box part),
                      const void *what);

/* The scalar reference of the user interface's triangles: e3d_ui_draw without its checks. */
#ifndef E3D_REFERENCE_UI_H
#define E3D_REFERENCE_UI_H

#include "e3d_ui.h"

void e3d_reference_ui(const e3d_canvas *picture, const e3d_ui_list *list);

#endif

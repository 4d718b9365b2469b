/* The scalar reference of the user interface's triangles: e3d_ui_draw without its checks. */
#pragma once

#include "e3d_ui.h"

void e3d_reference_ui(const e3d_canvas *picture, const e3d_ui_list *list);

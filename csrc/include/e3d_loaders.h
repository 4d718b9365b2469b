/* Reads model files: bytes in, arrays out. No files, no Python, no renderer.
 * Always: nothing outside the bytes given is read, whatever they hold; time and memory are linear in their number (but for
 * sorting); no locale; the same arrays on every machine. */
#pragma once

#include "e3d_forms.h"
#include "e3d_meshopt.h"
#include "e3d_numbers.h"
#include "e3d_obj.h"
#include "e3d_ply.h"
#include "e3d_rows.h"
#include "e3d_surfaces.h"

/* Random shadows for the lights of a scene. */
#pragma once

#include "check/driver/random.h"
#include "check/driver/scenes.h"

/* Gives most lights exact shadows, or maps, which show anything, and lets some draws receive no shadows. */
void scene_add_shadows(scene *s, random_stream *r);

/* Faces in mirrors show a picture of what these reflect (R210-R212). */
#pragma once

#include "e3d.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Whether faces of a material show mirrors. */
int e3d_may_mirror(const e3d_prepared *pass, const e3d_material *material);
/* These are steps: they find the share and the light of mirrors at a batch's samples, on entry with their own colours; and
 * lay that light over the light of the samples. */
void e3d_find_mirrors(const e3d_steps *s);
void e3d_lay_mirrors(const e3d_steps *s);

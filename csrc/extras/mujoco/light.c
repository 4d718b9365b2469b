/* Light on faces, as OpenGL's fixed functions give it (R261; OpenGL 1.5, section 2.14): many corners at once.
 * In: corners in the world. Out: colours of 0 .. 1, for the first pass and for each light with shadows. */
#include <math.h>

#include "extras/mujoco/shading.h"

void muj_set_lamps(const muj_picture *picture, const muj_view *view, int all_lights, muj_lamps *out)
{
    const e3d_muj_frame *frame = picture->frame;
    int pass = 1;
    out->count = frame->light_count;
    out->passes = all_lights ? 1 : 1 + picture->shadow_count;
    out->ambient = frame->ambient;
    for (int c = 0; c < 3; c++)
        out->eye[c] = (float)view->eye[c];
    for (int32_t i = 0; i < frame->light_count; i++) {
        const e3d_muj_light *light = &frame->lights[i];
        muj_lamp *lamp = &out->lamp[i];
        float length = sqrtf((light->dir[0] * light->dir[0] + light->dir[1] * light->dir[1]) + light->dir[2] * light->dir[2]);
        lamp->is_directional = light->is_directional;
        lamp->pass = pass < out->passes && picture->shadow_lights[pass - 1] == i ? pass++ : 0;
        for (int c = 0; c < 3; c++)
            lamp->dir[c] = length > 0 ? light->dir[c] / length : light->dir[c];
        memcpy(lamp->pos, light->pos, sizeof lamp->pos);
        memcpy(lamp->attenuation, light->attenuation, sizeof lamp->attenuation);
        memcpy(lamp->ambient, light->ambient, sizeof lamp->ambient);
        memcpy(lamp->diffuse, light->diffuse, sizeof lamp->diffuse);
        memcpy(lamp->specular, light->specular, sizeof lamp->specular);
        lamp->exponent = light->exponent, lamp->cutoff_cosine = light->cutoff_cosine;
    }
}

void muj_add_corners(muj_shader *shader, const muj_draw *draw, int32_t face, const float place[3][3], const float normal[3][3])
{
    muj_corners *corners = &shader->corners;
    if (corners->count == MUJ_CORNERS)
        muj_light_faces(shader);
    shader->lit[corners->count / 3] = face;
    for (int k = 0; k < 3; k++) {
        int i = corners->count++;
        for (int c = 0; c < 3; c++) {
            corners->place[c][i] = place[k][c], corners->normal[c][i] = normal[k][c];
            corners->rgb[c][i] = draw->rgba[c] * shader->view->tint;
        }
        corners->emission[i] = draw->geom->emission;
        corners->specular[i] = draw->geom->specular, corners->shininess[i] = draw->geom->shininess;
    }
}

void muj_light_faces(muj_shader *shader)
{
    muj_corners *corners = &shader->corners;
    float *faces = shader->faces.data;
    shader->picture->kernels->light(&shader->lamps, corners);
    for (int i = 0; i < corners->count; i++) {
        float *face = faces + shader->lit[i / 3];
        for (int p = 0; p < shader->lamps.passes; p++)
            for (int c = 0; c < 3; c++)
                face[muj_color_at(p) + 3 * c + i % 3] = corners->color[p][c][i];
    }
    corners->count = 0;
}

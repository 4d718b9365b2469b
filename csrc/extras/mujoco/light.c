/* Light on vertices, as OpenGL's fixed functions give it (R261; OpenGL 1.5, section 2.14).
 * In: a vertex in the world. Out: colours of 0 .. 1, for the first pass and for each light with shadows. */
#include <math.h>

#include "extras/mujoco/shading.h"
#include "extras/mujoco/power.h"

static float dot(const float a[3], const float b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static float make_unit(float a[3])
{
    float length = sqrtf(dot(a, a));
    for (int c = 0; c < 3 && length > 0; c++)
        a[c] /= length;
    return length;
}

/* How much of a light arrives, and from where. */
static float find_strength(const e3d_muj_light *light, const double place[3], float to_light[3])
{
    float dir[3] = {light->dir[0], light->dir[1], light->dir[2]};
    make_unit(dir);
    if (light->is_directional) {
        for (int c = 0; c < 3; c++)
            to_light[c] = -dir[c];
        return 1;
    }
    for (int c = 0; c < 3; c++)
        to_light[c] = (float)(light->pos[c] - place[c]);
    float distance = make_unit(to_light), inside = -dot(to_light, dir), cone = 1;
    if (light->cutoff_cosine > -1) {
        if (inside < light->cutoff_cosine)
            return 0;
        cone = muj_power(inside > 0 ? inside < 1 ? inside : 1 : 0, light->exponent);
    }
    const float *a = light->attenuation;
    return cone / ((a[0] + a[1] * distance) + a[2] * (distance * distance));
}

static void add_light(const e3d_muj_light *light, const e3d_muj_geom *geom, const float rgb[3], const double place[3], const float normal[3],
                      const float to_eye[3], float out[3])
{
    float to_light[3], strength = find_strength(light, place, to_light), shine = 0;
    if (strength == 0)
        return;
    float facing = dot(normal, to_light), most = facing > 0 ? facing : 0;
    if (facing > 0 && geom->specular != 0) {
        float half[3] = {to_light[0] + to_eye[0], to_light[1] + to_eye[1], to_light[2] + to_eye[2]};
        make_unit(half);
        float near = dot(normal, half);
        shine = muj_power(near > 0 ? near < 1 ? near : 1 : 0, geom->shininess * 128);
    }
    for (int c = 0; c < 3; c++)
        out[c] += strength * ((light->ambient[c] * rgb[c] + most * (light->diffuse[c] * rgb[c])) + shine * (light->specular[c] * geom->specular));
}

void muj_light_vertex(const muj_picture *picture, const muj_view *view, const muj_draw *draw, const double place[3], const float normal[3],
                      int all_lights, float out[MUJ_PASSES][3])
{
    const e3d_muj_frame *frame = picture->frame;
    float rgb[3], unit[3] = {normal[0], normal[1], normal[2]}, to_eye[3];
    for (int c = 0; c < 3; c++) {
        rgb[c] = draw->rgba[c] * view->tint;
        to_eye[c] = (float)(view->eye[c] - place[c]);
        out[0][c] = draw->geom->emission * rgb[c] + frame->ambient * rgb[c];
        for (int p = 1; p <= picture->shadow_count; p++)
            out[p][c] = 0;
    }
    make_unit(unit);
    make_unit(to_eye);
    int pass = 1;
    for (int32_t i = 0; i < frame->light_count; i++) {
        int own = !all_lights && pass <= picture->shadow_count && picture->shadow_lights[pass - 1] == i;
        add_light(&frame->lights[i], draw->geom, rgb, place, unit, to_eye, out[own ? pass++ : 0]);
    }
    for (int p = 0; p <= picture->shadow_count; p++)
        for (int c = 0; c < 3; c++)
            out[p][c] = out[p][c] > 0 ? out[p][c] < 1 ? out[p][c] : 1 : 0;
}

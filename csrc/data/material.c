/* Materials: their textures by number, from the list in e3d_material.h. */
#include "e3d.h"

void e3d_material_set_texture(e3d_material *material, e3d_texture_slot slot, const e3d_texture_use *use)
{
    switch (slot) {
#define SET(slot, name) \
    case slot: material->name = *use; return;
        E3D_EACH_TEXTURE_SLOT(SET)
    case E3D_TEXTURE_SLOTS: return;
    }
}

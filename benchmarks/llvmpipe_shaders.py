"""The GLSL programs of the peer that draws with OpenGL: the light of docs/conventions.md, plain.

albedo * (ambient + sun * max(0, n.l) + the point lights within their ranges), on 8-bit values as
they are. Macros choose what a mesh and a picture need.
"""

VERTEX = """
in vec3 position;
#ifdef INSTANCED
in vec4 instance;
in vec4 instance_color;
#endif
#ifndef DEPTH
in vec4 normal;
in vec4 color;
in vec2 uv;
out vec3 n;
out vec4 c;
out vec2 t;
#endif
#ifdef IDS
flat out uint id;
#endif
uniform mat4 clip_from_world;
void main() {
    vec3 p = position;
#ifdef INSTANCED
    p = p * instance.w + instance.xyz;
#endif
    gl_Position = clip_from_world * vec4(p, 1.0);
#ifndef DEPTH
    n = 2.0 * normal.xyz - 1.0;
    c = color;
    t = uv;
#ifdef INSTANCED
    c *= instance_color;
#endif
#endif
#ifdef IDS
    id = uint(gl_InstanceID);
#endif
}
"""

FRAGMENT = """
#ifdef IDS
flat in uint id;
out uint result;
void main() { result = id + 1u; }
#elif defined(DEPTH)
void main() {}
#else
in vec3 n;
in vec4 c;
in vec2 t;
uniform vec3 ambient, sun, to_sun;
uniform sampler2D image;
layout(location = 0) out vec4 result;
#ifdef GEOMETRY
layout(location = 1) out vec4 surface;
#endif
void main() {
    vec3 albedo = c.rgb;
#ifdef TEXTURED
    albedo *= texture(image, t).rgb;
#endif
#if defined(GEOMETRY)
    surface = vec4(normalize(n) * 0.5 + 0.5, 1.0);
#elif !defined(UNLIT)
    albedo *= ambient + sun * max(0.0, dot(normalize(n), to_sun));
#endif
    result = vec4(albedo, 1.0);
}
#endif
"""

#: A triangle over the whole picture.
SCREEN_VERTEX = """
out vec2 place;
void main() {
    place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(place, 0.0, 1.0);
}
"""

#: Every point light on every pixel of the geometry buffer.
LIGHTS_FRAGMENT = """
in vec2 place;
uniform sampler2D albedos, normals, depths;
uniform mat4 world_from_clip;
uniform vec3 ambient, sun, to_sun, background;
layout(std140) uniform Lights { vec4 lights[2 * COUNT]; };
out vec4 result;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).r;
    if (depth == 1.0) {
        result = vec4(background, 1.0);
        return;
    }
    vec4 h = world_from_clip * vec4(place, 2.0 * depth - 1.0, 1.0);
    vec3 p = h.xyz / h.w, n = normalize(texelFetch(normals, pixel, 0).xyz * 2.0 - 1.0);
    vec3 light = ambient + sun * max(0.0, dot(n, to_sun));
    for (int k = 0; k < COUNT; k++) {
        vec3 d = lights[2 * k].xyz - p;
        float square = dot(d, d), range = lights[2 * k].w;
        float window = max(0.0, 1.0 - square / (range * range));
        float strength = window * window * max(0.0, dot(n, d)) * inversesqrt(square);
        light += lights[2 * k + 1].rgb * strength;
    }
    result = vec4(texelFetch(albedos, pixel, 0).rgb * light, 1.0);
}
"""

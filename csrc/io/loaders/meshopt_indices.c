/* Indices of meshopt: triangles coded by the latest edges and vertices, or indices coded as deltas.
 * In: a stream, the count and size of its indices. Out: the indices, little-endian. */
#include "e3d_meshopt.h"

enum { FIFO = 16,
       TRIANGLES = 0xE1,
       INDICES = 0xD1,
       TABLE = 16,
       INDICES_TAIL = 4 };

typedef struct edge {
    uint32_t a, b;
} edge;

typedef struct stream {
    const uint8_t *at, *end;
    bool bad;
    uint32_t next, last;
    edge edges[FIFO];
    uint32_t vertices[FIFO];
    size_t edge_count, vertex_count; /* how many were ever pushed */
} stream;

static uint32_t take_byte(stream *s)
{
    s->bad |= s->at == s->end;
    return s->bad ? 0 : *s->at++;
}

/* A number of 1 to 5 bytes of 7 bits each, the lowest first. */
static uint32_t take_number(stream *s)
{
    uint32_t number = 0;
    for (int k = 0; k < 5; k++) {
        const uint32_t byte = take_byte(s);
        number |= (byte & 0x7F) << 7 * k;
        if (byte < 0x80)
            return number;
    }
    s->bad = true;
    return 0;
}

static inline uint32_t unzigzag(uint32_t v) { return (v & 1) ? ~(v >> 1) : v >> 1; }

static uint32_t take_index(stream *s) { return s->last += unzigzag(take_number(s)); }

static void push_edge(stream *s, uint32_t a, uint32_t b) { s->edges[s->edge_count++ % FIFO] = (edge){a, b}; }

static void push_vertex(stream *s, uint32_t v) { s->vertices[s->vertex_count++ % FIFO] = v; }

/* The edge pushed `back` pushes before the last one. */
static edge edge_at(stream *s, uint32_t back)
{
    s->bad |= back >= s->edge_count;
    return s->bad ? (edge){0, 0} : s->edges[(s->edge_count - 1 - back) % FIFO];
}

static uint32_t vertex_at(stream *s, uint32_t back)
{
    s->bad |= back >= s->vertex_count;
    return s->bad ? 0 : s->vertices[(s->vertex_count - 1 - back) % FIFO];
}

/* The second or third corner of a triangle that shares no edge. */
static uint32_t corner(stream *s, uint32_t kind, bool may_be_explicit)
{
    if (kind == 0)
        return s->next++;
    return kind == 15 && may_be_explicit ? take_index(s) : vertex_at(s, kind - 1);
}

static void take_free_triangle(stream *s, uint32_t code, const uint8_t *table, uint32_t corners[3])
{
    const bool is_explicit = (code & 15) >= 14;
    const uint32_t kinds = is_explicit ? take_byte(s) : table[code & 15];
    const uint32_t second = kinds >> 4, third = kinds & 15;
    if (is_explicit && kinds == 0)
        s->next = 0;
    const uint32_t a = code == 0xFF ? take_index(s) : s->next++;
    const uint32_t b = corner(s, second, is_explicit), c = corner(s, third, is_explicit);
    push_edge(s, b, a);
    push_edge(s, c, b);
    push_edge(s, a, c);
    push_vertex(s, a);
    if (second == 0 || second == 15)
        push_vertex(s, b);
    if (third == 0 || third == 15)
        push_vertex(s, c);
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

static void take_triangle(stream *s, uint32_t code, const uint8_t *table, uint32_t corners[3])
{
    const uint32_t kind = code & 15;
    if (code >> 4 == 15) {
        take_free_triangle(s, code, table, corners);
        return;
    }
    const edge shared = edge_at(s, code >> 4);
    uint32_t c;
    if (kind == 0)
        c = s->next++;
    else if (kind < 13)
        c = vertex_at(s, kind);
    else if (kind < 15)
        c = s->last += kind == 13 ? UINT32_MAX : 1;
    else
        c = take_index(s);
    push_edge(s, c, shared.b);
    push_edge(s, shared.a, c);
    if (kind == 0 || kind >= 13)
        push_vertex(s, c);
    corners[0] = shared.a;
    corners[1] = shared.b;
    corners[2] = c;
}

static void put_index(uint8_t *to, size_t place, size_t stride, uint32_t index)
{
    for (size_t k = 0; k < stride; k++)
        to[place * stride + k] = (uint8_t)(index >> 8 * k);
}

static bool is_table(const uint8_t *table)
{
    for (int k = 0; k < TABLE; k++)
        if (table[k] >> 4 == 15 || (table[k] & 15) == 15)
            return false;
    return table[TABLE - 2] == 0 && table[TABLE - 1] == 0;
}

bool e3d_meshopt_triangles(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t stride)
{
    const size_t triangles = count / 3;
    if (size < 1 + TABLE || bytes[0] != TRIANGLES || size - 1 - TABLE < triangles || !is_table(bytes + size - TABLE))
        return false;
    stream s = {.at = bytes + 1 + triangles, .end = bytes + size - TABLE};
    for (size_t t = 0; t < triangles && !s.bad; t++) {
        uint32_t corners[3];
        take_triangle(&s, bytes[1 + t], s.end, corners);
        for (size_t k = 0; k < 3; k++)
            put_index(to, 3 * t + k, stride, corners[k]);
    }
    return !s.bad && s.at == s.end;
}

bool e3d_meshopt_indices(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t stride)
{
    if (size < 1 + INDICES_TAIL || bytes[0] != INDICES)
        return false;
    stream s = {.at = bytes + 1, .end = bytes + size - INDICES_TAIL};
    uint32_t last[2] = {0, 0};
    for (size_t k = 0; k < count && !s.bad; k++) {
        const uint32_t number = take_number(&s);
        last[number & 1] += unzigzag(number >> 1);
        put_index(to, k, stride, last[number & 1]);
    }
    return !s.bad && s.at == s.end;
}

/* Outer faces of solids: those whose nodes no other solid of the same part has. */
#include "solver/solid_faces.h"

#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"

enum { FACES = 6 };

/* Corners of a hexahedron's faces, outward for N1..N4 below N5..N8. */
static const int corners[FACES][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/* One face: its part and sorted nodes tell it from others. */
typedef struct Face {
    int part, sorted[4];
    int node[4]; /* a triangle repeats the third */
    size_t place;
} Face;

/* The face of the solid without repeated neighbours; false if fewer than three corners are left. */
static bool cut_face(const SolidDefinition *solid, int number, Face *face)
{
    int count = 0, node[4];
    for (int i = 0; i < 4; i++) {
        int here = solid->node[corners[number][i]], next = solid->node[corners[number][(i + 1) % 4]];
        if (here != next) node[count++] = here;
    }
    if (count < 3 || (count == 4 && (node[0] == node[2] || node[1] == node[3]))) return false;
    if (count == 3) node[3] = node[2];
    memcpy(face->node, node, sizeof node);
    memcpy(face->sorted, node, sizeof node);
    for (int i = 1; i < 4; i++)
        for (int j = i; j > 0 && face->sorted[j - 1] > face->sorted[j]; j--) {
            int swap = face->sorted[j];
            face->sorted[j] = face->sorted[j - 1];
            face->sorted[j - 1] = swap;
        }
    /* a triangle's repeated node is not a mark of its own */
    if (count == 3)
        for (int i = 1; i < 4; i++)
            if (face->sorted[i] == face->sorted[i - 1]) {
                memmove(face->sorted + i, face->sorted + i + 1, (size_t)(3 - i) * sizeof *face->sorted);
                face->sorted[3] = 0;
                break;
            }
    return true;
}

static int compare_faces(const void *left, const void *right)
{
    const Face *a = left, *b = right;
    if (a->part != b->part) return a->part < b->part ? -1 : 1;
    for (int i = 0; i < 4; i++)
        if (a->sorted[i] != b->sorted[i]) return a->sorted[i] < b->sorted[i] ? -1 : 1;
    return a->place < b->place ? -1 : a->place > b->place;
}

static bool same_nodes(const Face *a, const Face *b)
{
    return a->part == b->part && memcmp(a->sorted, b->sorted, sizeof a->sorted) == 0;
}

static int compare_places(const void *left, const void *right)
{
    const Face *a = left, *b = right;
    return a->place < b->place ? -1 : a->place > b->place;
}

int solid_faces_add(Definitions *d, Diagnostics *diagnostics)
{
    size_t count = 0, kept = 0;
    if (d->solids.count == 0) return 0;
    Face *faces = memory_alloc(FACES * d->solids.count, sizeof *faces);
    for (size_t s = 0; faces && s < d->solids.count; s++)
        for (int f = 0; f < FACES; f++) {
            Face *face = &faces[count];
            if (!cut_face(&d->solids.items[s], f, face)) continue;
            face->part = d->solids.items[s].part;
            face->place = FACES * s + (size_t)f;
            count++;
        }
    if (faces) qsort(faces, count, sizeof *faces, compare_faces);
    for (size_t i = 0; i < count;) {
        size_t end = i + 1;
        while (end < count && same_nodes(&faces[i], &faces[end])) end++;
        if (end == i + 1) faces[kept++] = faces[i];
        i = end;
    }
    if (kept > 1) qsort(faces, kept, sizeof *faces, compare_places);
    if (!faces || memory_reserve((void **)&d->shells.items, &d->shells.capacity, d->shells.count + kept,
                                 sizeof *d->shells.items)) {
        memory_free(faces);
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, "*ELEMENT_SOLID",
                        "not enough memory for the faces of the solids");
        return -1;
    }
    for (size_t i = 0; i < kept; i++) {
        const SolidDefinition *solid = &d->solids.items[faces[i].place / FACES];
        ShellDefinition *shell = &d->shells.items[d->shells.count++];
        *shell = (ShellDefinition){.id = solid->id, .part = solid->part, .is_face = true, .source = solid->source};
        memcpy(shell->node, faces[i].node, sizeof shell->node);
    }
    d->face_count = kept;
    memory_free(faces);
    return 0;
}

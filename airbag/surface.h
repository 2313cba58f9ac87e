/* The bag's surface: orientation of its facets and closure of its holes (docs/theory.md, section Surface). */
#ifndef BILLOW_SURFACE_H
#define BILLOW_SURFACE_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/diagnostics.h"

/* One free-edge loop covered by a flat cap; triangles of the fan about the loop's mean point count in the volume. */
typedef struct SurfaceCap {
    int count;        /* corners */
    int32_t *node;    /* (count) in the order that makes the cap's normal point outwards, owned by the closure */
    double area;      /* initial length of the area vector [L2] */
    double size;      /* initial diameter about the centre [L] */
    double planarity; /* largest distance from the mean plane over the size, initially */
    double centre[3]; /* mean of the nodes, initially [L] */
    int fixed_count;  /* how many of its nodes never move (of SurfaceInput.fixed, else filled by the owner of the model)
                       */
} SurfaceCap;

typedef struct SurfaceClosure {
    int cap_count; /* holes + seams */
    SurfaceCap
        *caps;      /* (cap_count): the holes' caps, then the seams' slivers; all count in volume, gradient and force */
    int holes;      /* free-edge loops capped */
    int seams;      /* slivers of hanging nodes closed as seams (no area to speak of) */
    int turned;     /* facets whose stored winding was reversed */
    int inner;      /* facets of sign 0 */
    int free_edges; /* edges of one facet before closing, without those of inner facets */
    int components; /* closed shells: facets joined through edges, seams and caps */
    double volume;  /* initial, enclosed [L3] */
    double area;    /* initial, facets only, without inner ones [L2] */
    double cap_area;     /* initial, of the holes' caps [L2] */
    int32_t *node_store; /* all caps' nodes, owned */
} SurfaceClosure;

/* Facets of one bag: input to the closure. */
typedef struct SurfaceInput {
    int facet_count;
    const int32_t *node; /* (facet_count x 4), triangles repeat the third */
    const int *facet_id; /* user's ids of the shells or segments for messages (facet_count) */
    const double *x;     /* positions (.. x 3) [L] */
    const int *node_id;  /* user's node ids for messages */
    const bool *fixed;   /* nodes that never move (..), or NULL if not known */
    const char *name;    /* "airbag 1" for messages */
    Source source;       /* of the *AIRBAG card */
    const char *keyword;
} SurfaceInput;

/* Orients all facets consistently and outwards (sign[i] = +1 keep, -1 turn; facet_count), finds the free-edge loops and
 * caps them. sign[i] = 0 marks an inner facet, whose two faces both see this bag's gas (or neither does): a tether, a
 * flap, a wall between two chambers of one bag, a second layer on the same nodes; it takes no pressure, has no share in
 * volume and area. Facets with fewer than three different nodes keep +1 and count for nothing.
 *
 * Returns 0; -1 with an error in diagnostics if the surface cannot be oriented (the edge is named), is open (the loop
 * is named) or memory is short; the closure is then empty. The report goes to diagnostics as notes, a hole larger than
 * the rest of the bag or far from plane as a warning. The result depends on the order of the facets and nodes alone.
 * O(n log n). */
int surface_close(const SurfaceInput *input, int *sign, SurfaceClosure *closure, Diagnostics *diagnostics);

/* Volume under caps and seams about origin at positions x (S7) [L3]. */
double surface_cap_volume(const SurfaceClosure *closure, const double *x, const double origin[3]);

/* Exact gradient of surface_cap_volume (S8): adds scale * dV_cap/dx to f (.. x 3). It depends on the origin as V does:
 * add it to the facets' gradients about the same origin. */
void surface_cap_gradient(const SurfaceClosure *closure, const double *x, const double origin[3], double scale,
                          double *f);

/* The same without an origin: adds scale times the caps' area vectors, shared among their nodes (S9), to f (.. x 3).
 * Added to the facets' area vectors (volume_triangle_shares, volume_quad_shares, the element kernels) it gives the
 * exact gradient of the whole closed volume: with scale = pressure, the cap's force on its rim. */
void surface_cap_force(const SurfaceClosure *closure, const double *x, double scale, double *f);

/* Releases the closure and empties it; a zeroed one is allowed. */
void surface_closure_free(SurfaceClosure *closure);

#endif

/* Contact surfaces of the Model: triangles and their neighbours, edges, nodes, in internal numbers. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solver/build_contact.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* Pairs remembered for each node and edge in State; more than that lose their memory at a restart only. */
enum { MEMORY_BY_NODE = 8 };

/* One side of a triangle, or of a facet, for finding what lies beyond. */
typedef struct HalfEdge {
    int32_t low, high;
    int32_t owner, place; /* triangle and edge number; facet and side number */
} HalfEdge;

static int compare_half_edges(const void *left, const void *right)
{
    const HalfEdge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    if (a->owner != b->owner) return a->owner < b->owner ? -1 : 1;
    return (a->place > b->place) - (a->place < b->place);
}

static HalfEdge half_edge(int32_t a, int32_t b, int32_t owner, int32_t place)
{
    return (HalfEdge){a < b ? a : b, a < b ? b : a, owner, place};
}

static double distance(const double *x, int32_t a, int32_t b)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += (x[3 * a + k] - x[3 * b + k]) * (x[3 * a + k] - x[3 * b + k]);
    return sqrt(sum);
}

/* Rigid body of an element's part. */
static int32_t facet_body(const Builder *b, const ContactFacet *facet)
{
    return facet->shell < 0 ? -1 : b->motion.part_body[b->records[facet->shell].part];
}

static void add_triangle(Builder *b, ContactInterface *c, const ContactFacet *facet, int32_t u, int32_t v, int32_t w,
                         int32_t fourth)
{
    int t = c->triangle_count++;
    c->triangle[3 * t] = u;
    c->triangle[3 * t + 1] = v;
    c->triangle[3 * t + 2] = w;
    c->triangle_shell[t] = facet->shell;
    c->triangle_fourth[t] = fourth;
    c->triangle_side[t] = (unsigned char)facet->side;
    c->triangle_body[t] = facet_body(b, facet);
    c->triangle_radius[t] = facet->radius;
}

/* Facets to triangles; quadrilaterals are cut along their shorter diagonal. */
static int make_triangles(Builder *b, const ContactSurfaces *s, ContactInterface *c)
{
    size_t most = 2 * s->facets.count + 1;
    c->triangle = builder_alloc(b, 3 * most, sizeof *c->triangle);
    c->neighbour = builder_alloc(b, 3 * most, sizeof *c->neighbour);
    c->triangle_shell = builder_alloc(b, most, sizeof *c->triangle_shell);
    c->triangle_fourth = builder_alloc(b, most, sizeof *c->triangle_fourth);
    c->triangle_side = builder_alloc(b, most, 1);
    c->triangle_body = builder_alloc(b, most, sizeof *c->triangle_body);
    c->triangle_radius = builder_alloc(b, most, sizeof *c->triangle_radius);
    c->corner_rim = builder_alloc(b, 3 * most, 1);
    if (!c->triangle || !c->neighbour || !c->triangle_shell || !c->triangle_fourth || !c->triangle_side ||
        !c->triangle_body || !c->triangle_radius || !c->corner_rim)
        return -1;
    for (size_t i = 0; i < s->facets.count; i++) {
        const ContactFacet *facet = &s->facets.items[i];
        int32_t n[4];
        for (int a = 0; a < 4; a++) n[a] = b->model->deck_node[facet->node[a]];
        if (n[3] == n[2]) {
            add_triangle(b, c, facet, n[0], n[1], n[2], -1);
        } else if (distance(b->model->initial, n[0], n[2]) <= distance(b->model->initial, n[1], n[3])) {
            add_triangle(b, c, facet, n[0], n[1], n[2], n[3]);
            add_triangle(b, c, facet, n[0], n[2], n[3], n[1]);
        } else {
            add_triangle(b, c, facet, n[0], n[1], n[3], n[2]);
            add_triangle(b, c, facet, n[1], n[2], n[3], n[0]);
        }
    }
    double sum = 0.0;
    for (int t = 0; t < c->triangle_count; t++) {
        double longest = 0.0;
        for (int a = 0; a < 3; a++)
            longest =
                fmax(longest, distance(b->model->initial, c->triangle[3 * t + a], c->triangle[3 * t + (a + 1) % 3]));
        sum += longest;
    }
    c->longest_side = c->triangle_count ? sum / c->triangle_count : 0.0;
    return 0;
}

/* The triangle beyond each edge, and the corners on rims. */
static int find_neighbours(Builder *b, ContactInterface *c)
{
    size_t count = 3 * (size_t)c->triangle_count;
    HalfEdge *edges = memory_alloc(count + 1, sizeof *edges);
    unsigned char *rim = memory_alloc((size_t)b->model->node_count + 1, 1);
    if (!edges || !rim) {
        memory_free(edges);
        memory_free(rim);
        return -1;
    }
    for (int t = 0; t < c->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            edges[3 * t + k] = half_edge(c->triangle[3 * t + (k + 1) % 3], c->triangle[3 * t + (k + 2) % 3], t, k);
    qsort(edges, count, sizeof *edges, compare_half_edges);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && edges[end].low == edges[i].low && edges[end].high == edges[i].high;) end++;
        for (size_t k = i; k < end; k++) {
            size_t other = k == i ? i + 1 : i;
            c->neighbour[3 * edges[k].owner + edges[k].place] = end - i == 1   ? CONTACT_BOUNDARY
                                                                : end - i == 2 ? edges[other].owner
                                                                               : CONTACT_BRANCH;
        }
        if (end - i != 2) rim[edges[i].low] = rim[edges[i].high] = 1;
    }
    for (size_t i = 0; i < count; i++) c->corner_rim[i] = rim[c->triangle[i]];
    memory_free(edges);
    memory_free(rim);
    return 0;
}

/* Does the neighbour run through the common edge the other way, as surfaces wound alike do? */
static bool wound_alike(const ContactInterface *c, int t, int k, int other)
{
    int32_t from = c->triangle[3 * t + (k + 1) % 3], to = c->triangle[3 * t + (k + 2) % 3];
    for (int j = 0; j < 3; j++)
        if (c->triangle[3 * other + j] == to && c->triangle[3 * other + (j + 1) % 3] == from) return true;
    return false;
}

static void turn_triangle(ContactInterface *c, int t)
{
    int32_t node = c->triangle[3 * t + 1], beyond = c->neighbour[3 * t + 1];
    unsigned char rim = c->corner_rim[3 * t + 1];
    c->triangle[3 * t + 1] = c->triangle[3 * t + 2];
    c->neighbour[3 * t + 1] = c->neighbour[3 * t + 2];
    c->corner_rim[3 * t + 1] = c->corner_rim[3 * t + 2];
    c->triangle[3 * t + 2] = node;
    c->neighbour[3 * t + 2] = beyond;
    c->corner_rim[3 * t + 2] = rim;
}

/* Winds each connected piece alike, from its first triangle on. */
static int wind_alike(ContactInterface *c)
{
    unsigned char *seen = memory_alloc((size_t)c->triangle_count + 1, 1);
    int32_t *queue = memory_alloc((size_t)c->triangle_count + 1, sizeof *queue);
    if (!seen || !queue) {
        memory_free(seen);
        memory_free(queue);
        return -1;
    }
    for (int first = 0; first < c->triangle_count; first++) {
        int head = 0, tail = 0;
        if (seen[first]) continue;
        seen[first] = 1;
        queue[tail++] = first;
        while (head < tail) {
            int t = queue[head++];
            for (int k = 0; k < 3; k++) {
                int other = c->neighbour[3 * t + k];
                if (other < 0 || seen[other]) continue;
                if (!wound_alike(c, t, k, other)) turn_triangle(c, other);
                seen[other] = 1;
                queue[tail++] = other;
            }
        }
    }
    memory_free(seen);
    memory_free(queue);
    return 0;
}

/* Is the edge opposite to corner k of triangle t the cut of a rigid quadrilateral that is as good as flat: its
 * diagonals less than a tenth of the thickness apart? It stays so, and what keeps clear of its sides keeps clear of it.
 */
static bool is_idle_cut(const Builder *b, const ContactInterface *c, int t, int k)
{
    const double *x = b->model->initial;
    const int32_t *corner = c->triangle + 3 * (ptrdiff_t)t;
    const int32_t fourth = c->triangle_fourth[t];
    int other = c->neighbour[3 * t + k];
    double u[3], w[3], r[3], n[3];
    if (c->triangle_body[t] < 0 || other < 0 || fourth < 0) return false;
    if (c->triangle_shell[other] != c->triangle_shell[t]) return false;
    const double *from = x + 3 * (ptrdiff_t)corner[(k + 1) % 3];
    vector3_subtract(x + 3 * (ptrdiff_t)corner[(k + 2) % 3], from, u);
    vector3_subtract(x + 3 * (ptrdiff_t)fourth, x + 3 * (ptrdiff_t)corner[k], w);
    vector3_subtract(x + 3 * (ptrdiff_t)corner[k], from, r);
    vector3_cross(u, w, n);
    vector3_normalize(n);
    return fabs(vector3_dot(n, r)) < 0.1 * c->thickest;
}

/* Edges with the triangles at them: of the facets, and the cuts of quadrilaterals, along which these fold where they
 * warp (docs/theory.md, Edges). */
static int make_edges(Builder *b, ContactInterface *c)
{
    size_t count = 0;
    HalfEdge *edges = memory_alloc(3 * (size_t)c->triangle_count + 1, sizeof *edges);
    if (!edges) return -1;
    for (int t = 0; t < c->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (!is_idle_cut(b, c, t, k))
                edges[count++] = half_edge(c->triangle[3 * t + (k + 1) % 3], c->triangle[3 * t + (k + 2) % 3], t, k);
    qsort(edges, count, sizeof *edges, compare_half_edges);
    c->edge = builder_alloc(b, 2 * count + 2, sizeof *c->edge);
    c->edge_triangle = builder_alloc(b, 2 * count + 2, sizeof *c->edge_triangle);
    c->edge_side = builder_alloc(b, count + 1, 1);
    c->edge_radius = builder_alloc(b, count + 1, sizeof *c->edge_radius);
    if (!c->edge || !c->edge_triangle || !c->edge_side || !c->edge_radius) {
        memory_free(edges);
        return -1;
    }
    for (size_t i = 0, end; i < count; i = end) {
        int e = c->edge_count++;
        c->edge[2 * e] = edges[i].low;
        c->edge[2 * e + 1] = edges[i].high;
        for (end = i; end < count && edges[end].low == edges[i].low && edges[end].high == edges[i].high; end++) {
            int t = edges[end].owner;
            c->edge_side[e] |= c->triangle_side[t];
            c->edge_radius[e] = fmax(c->edge_radius[e], c->triangle_radius[t]);
        }
        c->edge_triangle[2 * e] = edges[i].owner;
        c->edge_triangle[2 * e + 1] = end - i == 2 ? edges[i + 1].owner : -1;
    }
    memory_free(edges);
    return 0;
}

/* Edges at each node. */
static int list_edges(Builder *b, ContactInterface *c)
{
    size_t nodes = (size_t)b->model->node_count;
    c->edge_start = builder_alloc(b, nodes + 3, sizeof *c->edge_start);
    c->edge_list = builder_alloc(b, 2 * (size_t)c->edge_count + 1, sizeof *c->edge_list);
    if (!c->edge_start || !c->edge_list) return -1;
    for (int k = 0; k < 2 * c->edge_count; k++) c->edge_start[c->edge[k] + 2]++;
    for (size_t n = 0; n < nodes; n++) c->edge_start[n + 2] += c->edge_start[n + 1];
    for (int k = 0; k < 2 * c->edge_count; k++) c->edge_list[c->edge_start[c->edge[k] + 1]++] = k / 2;
    return 0;
}

/* Triangles at each node. */
static int list_fans(Builder *b, ContactInterface *c)
{
    size_t nodes = (size_t)b->model->node_count;
    c->fan_start = builder_alloc(b, nodes + 3, sizeof *c->fan_start);
    c->fan = builder_alloc(b, 3 * (size_t)c->triangle_count + 1, sizeof *c->fan);
    if (!c->fan_start || !c->fan) return -1;
    for (int k = 0; k < 3 * c->triangle_count; k++) c->fan_start[c->triangle[k] + 2]++;
    for (size_t n = 0; n < nodes; n++) c->fan_start[n + 2] += c->fan_start[n + 1];
    for (int k = 0; k < 3 * c->triangle_count; k++) c->fan[c->fan_start[c->triangle[k] + 1]++] = k / 3;
    return 0;
}

static int list_nodes(Builder *b, const ContactSurfaces *s, ContactInterface *c)
{
    int32_t *deck = memory_alloc((size_t)b->node_count + 1, sizeof *deck); /* deck node of each internal one */
    if (!deck) return -1;
    for (int i = 0; i < b->node_count; i++) {
        deck[b->model->deck_node[i]] = i;
        c->node_count += s->node_side[i] != 0;
    }
    size_t count = (size_t)c->node_count + 1;
    c->node = builder_alloc(b, count, sizeof *c->node);
    c->node_side = builder_alloc(b, count, 1);
    c->node_body = builder_alloc(b, count, sizeof *c->node_body);
    c->node_radius = builder_alloc(b, count, sizeof *c->node_radius);
    int status = c->node && c->node_side && c->node_body && c->node_radius ? 0 : -1;
    for (int n = 0, k = 0; !status && n < b->node_count; n++) {
        if (!s->node_side[deck[n]]) continue;
        c->node[k] = n;
        c->node_side[k] = s->node_side[deck[n]];
        c->node_body[k] = b->motion.node_body ? b->motion.node_body[n] : -1;
        c->node_radius[k++] = s->node_radius[deck[n]];
    }
    memory_free(deck);
    return status;
}

/* Inverse masses: those of the model; a hanging node is as light as the lighter end of its edge. */
static int list_masses(Builder *b)
{
    Model *m = b->model;
    const Constraints *held = &b->motion.constraints;
    m->contact_inverse = builder_alloc(b, (size_t)m->node_count, sizeof *m->contact_inverse);
    if (!m->contact_inverse) return -1;
    memcpy(m->contact_inverse, m->inverse_mass, (size_t)m->node_count * sizeof *m->contact_inverse);
    for (int i = held->hanging_count - 1; i >= 0; i--) {
        const HangingNode *h = &held->hanging[i];
        double a = m->contact_inverse[h->end[0]], c = m->contact_inverse[h->end[1]];
        m->contact_inverse[h->node] = a > c ? a : c;
    }
    return 0;
}

int build_contact_surfaces(Builder *b)
{
    Model *m = b->model;
    if (model_has_contact(m) && list_masses(b)) return -1;
    for (int i = 0; i < m->contact_count; i++) {
        ContactInterface *c = &m->contacts[i];
        const ContactSurfaces *s = &b->contacts[i];
        bool edges = c->kind == CONTACT_SELF || c->kind == CONTACT_TWO_WAY;
        if (make_triangles(b, s, c) || find_neighbours(b, c) || wind_alike(c) || list_fans(b, c) || list_nodes(b, s, c))
            return -1;
        double node = 0.0, triangle = 0.0;
        for (int k = 0; k < c->node_count; k++) node = fmax(node, c->node_radius[k]);
        for (int t = 0; t < c->triangle_count; t++) triangle = fmax(triangle, c->triangle_radius[t]);
        c->thickest = edges ? 2.0 * triangle : node + triangle;
        if (node + triangle > c->thickest) c->thickest = node + triangle;
        if (edges && (make_edges(b, c) || list_edges(b, c))) return -1;
        c->first_memory = m->contact_memory_size;
        c->memory_capacity = MEMORY_BY_NODE * (c->node_count + c->edge_count) + 1;
        m->contact_memory_size += (size_t)c->memory_capacity;
    }
    return 0;
}

/* Compiled once per instruction set, with BILLOW_SHARP_TABLE naming its table. */
#include "contact/sharp_kernels.h"

#include "contact/near_lanes.h"

/* With n1 and n2 the normals of both triangles, w from the edge to the second's far corner: sin^2 = (n1 . w)^2
 * e^2/(n1^2 n2^2). Orders of magnitude stay small. */
static void find_turned(const ContactLanes *edges, const double *x, const float square[2], unsigned set[2])
{
    const double *origin = x + 3 * (ptrdiff_t)edges->node[0][0];
    set[0] = set[1] = 0;
    for (int r = 0; r < CONTACT_GROUP; r += NEAR_WIDTH) {
        Lanes a[3], e[3], v[3], w[3], n[3], m[3];
        lanes_points(x, edges->node[0] + r, origin, a);
        lanes_points(x, edges->node[1] + r, origin, e);
        lanes_points(x, edges->node[2] + r, origin, v);
        lanes_points(x, edges->node[3] + r, origin, w);
        for (int i = 0; i < 3; i++) e[i] -= a[i], v[i] -= a[i], w[i] -= a[i];
        for (int i = 0, j = 1, k = 2; i < 3; i++, j = (j + 1) % 3, k = (k + 1) % 3) {
            n[i] = e[j] * v[k] - e[k] * v[j];
            m[i] = w[j] * e[k] - w[k] * e[j];
        }
        Lanes ee = e[0] * e[0] + e[1] * e[1] + e[2] * e[2], nn = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        Lanes mm = m[0] * m[0] + m[1] * m[1] + m[2] * m[2], h = n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
        unsigned over = lanes_below(n[0] * m[0] + n[1] * m[1] + n[2] * m[2], lanes_of(0.0f));
        Lanes turned = h / lanes_replace(nn, lanes_below(nn, lanes_of(0.0f)), 1.0f) * h * ee;
        for (int i = 0; i < 2; i++) set[i] |= (over | lanes_below(square[i] * mm, turned)) << r;
    }
    unsigned none = items_equal(edges->item, -1);
    set[0] &= ~none, set[1] &= ~none;
}

const SharpKernels BILLOW_SHARP_TABLE = {.turned = find_turned};

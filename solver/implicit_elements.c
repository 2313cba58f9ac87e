/* What the factor of the implicit elements' matrix does: accelerations, and the inertia that it adds. */
#include "solver/implicit_elements.h"

#include <stddef.h>

enum { WIDTH = IMPLICIT_WIDTH };

void implicit_elements_solve(const ImplicitElements *s, double *a)
{
    for (int j = 0; j < s->node_count; j++)
        for (int32_t k = s->start[j]; k < s->start[j + 1]; k++)
            for (int i = 0; i < WIDTH; i++) a[WIDTH * s->row[k] + i] -= s->entry[k] * a[WIDTH * j + i];
    for (int j = s->node_count - 1; j >= 0; j--) {
        for (int i = 0; i < WIDTH; i++) a[WIDTH * j + i] *= s->inverse_pivot[j];
        for (int32_t k = s->start[j]; k < s->start[j + 1]; k++)
            for (int i = 0; i < WIDTH; i++) a[WIDTH * j + i] -= s->entry[k] * a[WIDTH * s->row[k] + i];
    }
}

ImplicitInertia implicit_elements_inertia(const ImplicitElements *s, const double *mass, const double *u,
                                          const double *w)
{
    ImplicitInertia sum = {0};
    for (int j = 0; j < s->node_count; j++)
        for (int i = 0; i < 3; i++) {
            const double *uj = u + 3 * (ptrdiff_t)s->node[j], *wj = w + 3 * (ptrdiff_t)s->node[j];
            double left = uj[i], right = wj[i]; /* of L^T u, L^T w */
            for (int32_t k = s->start[j]; k < s->start[j + 1]; k++) {
                const ptrdiff_t node = 3 * (ptrdiff_t)s->node[s->row[k]];
                left += s->entry[k] * u[node + i];
                right += s->entry[k] * w[node + i];
            }
            const double pivot = 1.0 / s->inverse_pivot[j], m = mass[s->node[j]];
            sum.uu += left * left * pivot - m * uj[i] * uj[i];
            sum.uw += left * right * pivot - m * uj[i] * wj[i];
            sum.ww += right * right * pivot - m * wj[i] * wj[i];
        }
    return sum;
}

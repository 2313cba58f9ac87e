/* Links in the step: forces, energies, stable step. */
#include "solver/step_links.h"

#include "solver/vector3.h"

/* From the first node to the second: unit vector and length. */
static double find_line(const Link *link, const double *x, double line[3])
{
    const double *far = link->node[1] < 0 ? link->ground : x + 3 * (ptrdiff_t)link->node[1];
    vector3_subtract(far, x + 3 * (ptrdiff_t)link->node[0], line);
    return vector3_normalize(line);
}

void links_act(const Model *m, State *state, double *f)
{
    for (int i = 0; i < m->link_count; i++) {
        const Link *link = &m->links[i];
        double line[3], energy, length = find_line(link, state->x, line);
        double tension = link_tension(link, length, state->link_peak[i], &energy);
        state->link_peak[i] = link_peak(link, length, state->link_peak[i]);
        state->part_energy[link->part] += energy - state->link_energy[i];
        state->link_energy[i] = energy;
        for (int end = 0; f && end < 2; end++) {
            if (link->node[end] < 0 || link->node[end] >= m->moving_count) continue;
            for (int k = 0; k < 3; k++)
                f[3 * (ptrdiff_t)link->node[end] + k] += (end == 0 ? tension : -tension) * line[k];
        }
    }
}

double links_rate(const Model *m, const double *x)
{
    double largest = 0.0;
    for (int i = 0; i < m->link_count; i++) {
        const Link *link = &m->links[i];
        double line[3], energy, length = find_line(link, x, line);
        double rate = link_rate(link, length, link_tension(link, length, 0.0, &energy));
        if (rate > largest || rate != rate) largest = rate;
    }
    return largest;
}

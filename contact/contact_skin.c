#include "contact/contact_skin.h"

#include <math.h>
#include <string.h>

#include "solver/vector3.h"

/* Steps at the largest speed of a chunk that its skin shall last. */
#define SKIN_STEPS 48.0

/* Least skin, as a share of the thickness or, without one, of the elements' side. */
#define SKIN_THICKNESSES 1.0
#define SKIN_SIDES 0.05

/* Mean velocity of the nodes that move: what goes with it does not come nearer. */
static void find_mean(const ContactLoop *loop, double mean[3])
{
    int count = loop->model->moving_count;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int n = 0; n < count; n++)
        for (int k = 0; k < 3; k++) sum[k] += loop->state->v[3 * (ptrdiff_t)n + k];
    for (int k = 0; k < 3; k++) mean[k] = count > 0 ? sum[k] / count : 0.0;
}

/* Bounds of all skins; cloth without thickness goes by its elements. */
static void find_bounds(const ContactLoop *loop, double *least, double *most)
{
    const Model *m = loop->model;
    double thickest = 0.0, side = INFINITY;
    for (int i = 0; i < m->contact_count; i++) {
        thickest = fmax(thickest, m->contacts[i].thickest);
        side = m->contacts[i].longest_side > 0.0 ? fmin(side, m->contacts[i].longest_side) : side;
    }
    *least = thickest > 0.0 ? SKIN_THICKNESSES * thickest : SKIN_SIDES * side;
    *most = side > *least ? side : *least;
}

void contact_skin_choose(ContactLoop *loop)
{
    const Model *m = loop->model;
    ContactSkin *skin = &loop->skin;
    double least, most, way = SKIN_STEPS * loop->step.longer;
    find_mean(loop, skin->velocity);
    find_bounds(loop, &least, &most);
    memcpy(skin->from, loop->state->x, 3 * (size_t)m->node_count * sizeof *skin->from);
    skin->since = 0.0;
    for (int first = 0; first < m->node_count; first += CONTACT_NODE_CHUNK) {
        double fastest = 0.0;
        for (int n = first; n < first + CONTACT_NODE_CHUNK && n < m->node_count; n++) {
            double u[3];
            vector3_subtract(loop->state->v + 3 * (ptrdiff_t)n, skin->velocity, u);
            fastest = fmax(fastest, vector3_dot(u, u));
        }
        double of_chunk = way * sqrt(fastest);
        skin->of[first / CONTACT_NODE_CHUNK] = of_chunk < least ? least : of_chunk > most ? most : of_chunk;
    }
}

/* Two steps more are asked for: pairs count before they touch (eq. C6a). */
bool contact_skin_used_up(ContactLoop *loop)
{
    const Model *m = loop->model;
    ContactSkin *skin = &loop->skin;
    skin->since += loop->step.next;
    for (int c = 0; c < loop->motion_count; c++) {
        const ContactMotion *motion = &loop->motions[c];
        double square = 0.0, left = skin->of[c] - 2.0 * loop->step.longer * sqrt(motion->fastest);
        for (int k = 0; k < 3; k++) {
            double way = fmax(-motion->drift.low[k], motion->drift.high[k]);
            square += way * way;
        }
        if (left < 0.0 || square > left * left) return true;
    }
    double away = (skin->since + 2.0 * loop->step.longer) * vector3_norm(skin->velocity); /* of nodes that never move */
    for (int n = m->moving_count; n < m->node_count; n += CONTACT_NODE_CHUNK)
        if (away > skin->of[n / CONTACT_NODE_CHUNK]) return true;
    return m->moving_count < m->node_count && away > skin->of[(m->node_count - 1) / CONTACT_NODE_CHUNK];
}

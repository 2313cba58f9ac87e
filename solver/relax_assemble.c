/* Residual and stiffness of the static equilibrium at given positions. */
#include "solver/relax_assemble.h"

#include <math.h>
#include <string.h>

#include "elements/static_element.h"
#include "solver/vector3.h"

/* The 3 x 3 block between two nodes in their unknowns, added to the lower triangle (column's node <= row's node).
 * block: rows of the row's node, leading dimension stride. */
static void add_block(RelaxSystem *s, int row, int column, double weight, const double *block, int stride)
{
    const RelaxNode *r = &s->nodes[row], *c = &s->nodes[column];
    int low = s->block_start[column], high = s->block_start[column + 1] - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (s->block_node[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    const int *start = s->matrix->p;
    double *value = s->matrix->x;
    for (int j = 0; j < c->count; j++) {
        double along[3];
        for (int i = 0; i < 3; i++)
            along[i] = block[i * stride] * c->basis[3 * j] + block[i * stride + 1] * c->basis[3 * j + 1] +
                       block[i * stride + 2] * c->basis[3 * j + 2];
        double *to = value + start[c->first + j] + s->block_row[low] - j;
        for (int i = row == column ? j : 0; i < r->count; i++) to[i] += weight * vector3_dot(r->basis + 3 * i, along);
    }
}

/* A small stiffness between count nodes (3 count square, row-major). */
static void add_stiffness(RelaxSystem *s, int count, const int32_t *node, const double *stiffness, int size)
{
    for (int a = 0; a < count; a++)
        for (int b = 0; b < count; b++) {
            const RelaxNode *ra = &s->nodes[node[a]], *rb = &s->nodes[node[b]];
            for (int i = 0; i < ra->master_count; i++)
                for (int j = 0; j < rb->master_count; j++) {
                    int row = ra->master[i], column = rb->master[j];
                    if (row < column || s->nodes[row].count == 0 || s->nodes[column].count == 0) continue;
                    add_block(s, row, column, ra->weight[i] * rb->weight[j], stiffness + 3 * a * size + 3 * b, size);
                }
        }
}

static void add_scale(RelaxSystem *s, int node, double value)
{
    const RelaxNode *own = &s->nodes[node];
    for (int i = 0; i < own->master_count; i++) {
        const RelaxNode *master = &s->nodes[own->master[i]];
        for (int k = 0; k < master->count; k++) s->scale[master->first + k] += own->weight[i] * own->weight[i] * value;
    }
}

static void add_group(RelaxSystem *s, const ElementGroup *group, const StaticLaw *law, const double *x, bool stiffness)
{
    int corners = group->corner_count;
    double pressure = group->pressure_set >= 0 ? s->pressure[group->pressure_set] : 0.0;
    for (int e = 0; e < group->element_count; e++) {
        int block = e / BILLOW_LANES, lane = e % BILLOW_LANES;
        int32_t node[STATIC_CORNERS];
        double corner[STATIC_CORNERS][3];
        StaticElement element;
        for (int a = 0; a < corners; a++) {
            node[a] = group->node[((ptrdiff_t)block * corners + a) * BILLOW_LANES + lane];
            memcpy(corner[a], x + 3 * (ptrdiff_t)node[a], sizeof corner[a]);
        }
        static_element(group, law, block, lane, corner, s->model->origin, stiffness, pressure, &element);
        for (int a = 0; a < corners; a++) {
            for (int k = 0; k < 3; k++) {
                double load = pressure * element.area[a][k];
                s->force[3 * (ptrdiff_t)node[a] + k] += element.force[a][k] + load;
                s->loads[3 * (ptrdiff_t)node[a] + k] += load;
            }
            if (stiffness) add_scale(s, node[a], element.scale[a]);
        }
        if (stiffness) add_stiffness(s, corners, node, element.stiffness, STATIC_SIZE);
    }
}

static void add_links(RelaxSystem *s, const double *x, bool stiffness)
{
    for (int i = 0; i < s->model->link_count; i++) {
        const Link *link = &s->model->links[i];
        const int ends = link->node[1] < 0 ? 1 : 2;
        const double *far = ends == 1 ? link->ground : x + 3 * (ptrdiff_t)link->node[1];
        double along[3], energy;
        vector3_subtract(far, x + 3 * (ptrdiff_t)link->node[0], along);
        double length = sqrt(vector3_dot(along, along));
        if (!(length > 0.0) && link->length != 0.0) continue;
        double tension = link_tension(link, length, 0.0, &energy);
        for (int k = 0; length > 0.0 && k < 3; k++) {
            along[k] /= length;
            s->force[3 * (ptrdiff_t)link->node[0] + k] += tension * along[k];
            if (ends == 2) s->force[3 * (ptrdiff_t)link->node[1] + k] -= tension * along[k];
        }
        if (!stiffness) continue;
        double slope = link_slope(link, length), across = tension > 0.0 ? tension / length : 0.0, k[36] = {0};
        if (!(length > 0.0)) across = slope; /* a spring without length pulls back from all sides alike */
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++)
                for (int r = 0; r < 3; r++)
                    for (int c = 0; c < 3; c++)
                        k[(3 * a + r) * 6 + 3 * b + c] =
                            (a == b ? 1.0 : -1.0) * ((slope - across) * along[r] * along[c] + (r == c ? across : 0.0));
        add_stiffness(s, ends, link->node, k, 6);
        double unit = link->logarithmic ? link->stiffness / link->length : link->stiffness;
        for (int a = 0; a < ends; a++) add_scale(s, link->node[a], unit);
    }
}

/* Gravity, point loads and the caps' pressure on their rims. */
static void add_loads(RelaxSystem *s, const double *x)
{
    const Model *m = s->model;
    for (int n = 0; m->node_class && n < m->node_count; n++)
        for (int k = 0; k < 3; k++) s->loads[3 * n + k] += m->mass[n] * s->gravity[3 * m->node_class[n] + k];
    loads_apply_points(&m->loads, m->curves, s->time, x, s->loads);
    for (int i = 0; m->caps_push_rim && i < m->airbag_count; i++)
        surface_cap_force(&m->airbags[i].closure, x, s->bag[i], s->loads);
}

/* Forces of all nodes to those of the unknowns. */
static void project(const RelaxSystem *s, const double *force, double *out)
{
    memset(out, 0, (size_t)s->unknown_count * sizeof *out);
    for (int n = 0; n < s->model->node_count; n++) {
        const RelaxNode *node = &s->nodes[n];
        for (int i = 0; i < node->master_count; i++) {
            const RelaxNode *master = &s->nodes[node->master[i]];
            for (int k = 0; k < master->count; k++)
                out[master->first + k] +=
                    node->weight[i] * vector3_dot(master->basis + 3 * k, force + 3 * (ptrdiff_t)n);
        }
    }
}

void relax_system_assemble(RelaxSystem *s, const double *x, bool stiffness, double *residual, double *load)
{
    const Model *m = s->model;
    size_t nodes = 3 * (size_t)m->node_count;
    memset(s->force, 0, nodes * sizeof *s->force);
    memset(s->loads, 0, nodes * sizeof *s->loads);
    if (stiffness) {
        memset(s->matrix->x, 0, s->matrix->nzmax * sizeof(double));
        memset(s->scale, 0, (size_t)s->unknown_count * sizeof *s->scale);
    }
    add_loads(s, x);
    memcpy(s->force, s->loads, nodes * sizeof *s->force);
    for (int g = 0; g < m->group_count; g++) add_group(s, &m->groups[g], &s->laws[g], x, stiffness);
    add_links(s, x, stiffness);
    double square = 0.0;
    project(s, s->loads, residual);
    for (int i = 0; i < s->unknown_count; i++) square += residual[i] * residual[i];
    *load = sqrt(square);
    project(s, s->force, residual);
}

void relax_stored_energy(const Model *m, const double *x, double *energy)
{
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        energy[g] = 0.0;
        if (group->law == LAW_SURFACE || group->part < 0) continue;
        StaticLaw law = static_law_make(group->law, &group->material);
        for (int e = 0; e < group->element_count; e++) {
            int block = e / BILLOW_LANES, lane = e % BILLOW_LANES;
            double corner[STATIC_CORNERS][3];
            StaticElement element;
            for (int a = 0; a < group->corner_count; a++) {
                int32_t node = group->node[((ptrdiff_t)block * group->corner_count + a) * BILLOW_LANES + lane];
                memcpy(corner[a], x + 3 * (ptrdiff_t)node, sizeof corner[a]);
            }
            static_element(group, &law, block, lane, corner, m->origin, false, 0.0, &element);
            energy[g] += element.energy;
        }
    }
}

/* Which thread works on which segment: equal shares of the time that their elements take. */
#include "elements/law.h"
#include "solver/memory.h"
#include "solver/workspace.h"

/* Does anything ask for the area of a part: a bag's leakage, an opening between bags? */
static bool part_is_measured(const Model *m, int part)
{
    for (int i = 0; i < m->airbag_count; i++)
        for (int k = 0; k < m->airbags[i].part_count; k++)
            if (m->airbags[i].part[k] == part) return true;
    for (int i = 0; i < m->connection_count; i++)
        if (m->connections[i].part == part) return true;
    return false;
}

/* About how long an element of the group takes, a triangle of FORM 0 having 1; 0: nothing needs it, a surface without
 * stress under no pressure. From benchmarks/speed.md and docs/theory.md's count of Newton's steps of FORM 2. */
static double element_cost(const Model *m, const ElementGroup *group)
{
    const bool quad = group->corner_count == 4;
    if (group->law == LAW_SURFACE)
        return group->pressure_set < 0 && !part_is_measured(m, group->part) ? 0.0 : quad ? 0.6 : 0.4;
    double cost = group->kind == ELEMENT_QUAD_FULL ? 3.0 : quad ? 1.3 : 1.0;
    bool field = group->law == LAW_GREEN && group->material.no_compression;
    return field || group->law == LAW_CURVE || group->law == LAW_RUBBER ? 4.0 * cost : cost;
}

int step_share_allocate(Workspace *w)
{
    const Model *m = w->model;
    double before = 0.0;
    w->segment_middle = memory_alloc((size_t)m->segment_count + 1, sizeof *w->segment_middle);
    if (!w->segment_middle) return -1;
    for (int i = 0; i < m->segment_count; i++) {
        int segment = m->segment_order[i], first = m->segment_chunk[segment];
        const ElementGroup *group = &m->groups[step_group_of_chunk(m, first)];
        double cost = (m->segment_chunk[segment + 1] - first) * element_cost(m, group);
        w->segment_middle[i] = cost > 0.0 ? before + 0.5 * cost : -1.0;
        before += cost;
    }
    w->segment_cost = before;
    return 0;
}

int step_segment_owner(const Workspace *w, int place, int threads)
{
    double middle = w->segment_middle[place];
    return middle < 0.0 ? -1 : (int)(middle / w->segment_cost * threads);
}

/* The elements with the smallest stable steps, for the report. */
#include "solver/element_steps.h"

#include <math.h>
#include <stdlib.h>

#include "elements/kernels.h"
#include "solver/memory.h"

/* The step of lane slot (counted from the group's first element), +infinity without stress. */
static double lane_step(const ElementGroup *group, int64_t slot)
{
    if (group->law == LAW_SURFACE) return INFINITY;
    const int64_t block = slot / BILLOW_LANES, lane = slot % BILLOW_LANES;
    const int64_t row = block * group->geometry_size + group->point_count * GEOMETRY_POINT_SIZE + GEOMETRY_RATE;
    const double rate = group->geometry[row * BILLOW_LANES + lane];
    return rate > 0.0 ? 2.0 / sqrt(rate) : INFINITY;
}

static const ElementGroup *find_group(const Model *model, int64_t slot)
{
    for (int i = 0; i < model->group_count; i++) {
        const ElementGroup *group = &model->groups[i];
        const int64_t first = group->first_element;
        if (slot >= first && slot < first + (int64_t)group->block_count * BILLOW_LANES) return group;
    }
    return NULL;
}

static int compare_steps(const void *left, const void *right)
{
    const ElementStep *a = left, *b = right;
    if (a->step != b->step) return a->step < b->step ? -1 : 1;
    return (a->element > b->element) - (a->element < b->element);
}

int element_steps_smallest(const Model *model, int limit, ElementStep *list)
{
    ElementStep *all = memory_alloc((size_t)model->element_count + 1, sizeof *all);
    if (!all) return 0;
    size_t count = 0;
    for (int i = 0; i < model->element_count; i++) {
        const int64_t slot = model->element_slot[i];
        const ElementGroup *group = find_group(model, slot);
        const double step = group ? lane_step(group, slot - group->first_element) : INFINITY;
        if (isfinite(step)) all[count++] = (ElementStep){i, step};
    }
    qsort(all, count, sizeof *all, compare_steps);
    const int listed = count < (size_t)limit ? (int)count : limit;
    for (int i = 0; i < listed; i++) list[i] = all[i];
    memory_free(all);
    return listed;
}

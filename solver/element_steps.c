/* The elements with the smallest stable steps, for the report. */
#include "solver/element_steps.h"

#include <math.h>
#include <stdlib.h>

#include "elements/kernels.h"
#include "solver/memory.h"

/* A constant of lane slot (counted from the group's first element), 0 without stress. */
static double lane_constant(const ElementGroup *group, int64_t slot, int constant)
{
    if (group->law == LAW_SURFACE) return 0.0;
    const int64_t block = slot / BILLOW_LANES, lane = slot % BILLOW_LANES;
    const int64_t row = block * group->geometry_size + group->point_count * GEOMETRY_POINT_SIZE + constant;
    return group->geometry[row * BILLOW_LANES + lane];
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

double element_steps_mesh(const Model *model)
{
    double largest = 0.0;
    for (int i = 0; i < model->group_count; i++)
        for (int64_t place = 0; place < model->groups[i].element_count; place++)
            largest = fmax(largest, lane_constant(&model->groups[i], place, GEOMETRY_RATE));
    return largest > 0.0 ? 2.0 / sqrt(largest) : 0.0;
}

int element_steps_smallest(const Model *model, int limit, ElementStep *list)
{
    ElementStep *all = memory_alloc((size_t)model->element_count + 1, sizeof *all);
    if (!all) return 0;
    size_t count = 0;
    for (int i = 0; i < model->element_count; i++) {
        const int64_t slot = model->element_slot[i];
        const ElementGroup *group = find_group(model, slot);
        const double step = group ? 2.0 * lane_constant(group, slot - group->first_element, GEOMETRY_PERIOD) : 0.0;
        if (step > 0.0) all[count++] = (ElementStep){i, step};
    }
    qsort(all, count, sizeof *all, compare_steps);
    const int listed = count < (size_t)limit ? (int)count : limit;
    for (int i = 0; i < listed; i++) list[i] = all[i];
    memory_free(all);
    return listed;
}

/* The groups as the kernels see them in a run. */
#include "solver/reference_work.h"

#include <string.h>

#include "solver/memory.h"

/* Constants of the geometry that holds, as if nothing had eroded. */
static void fill_geometry(const ElementGroup *group, const State *state, const ReferenceState *now, int first, int end,
                          double *own)
{
    const ptrdiff_t size = (ptrdiff_t)group->geometry_size * BILLOW_LANES;
    if (!now || !now->born) {
        const double *from = now ? group->mesh_geometry : group->geometry;
        memcpy(own + first * size, from + first * size, (size_t)((end - first) * size) * sizeof *own);
        return;
    }
    for (int64_t place = (int64_t)first * BILLOW_LANES; place < (int64_t)end * BILLOW_LANES; place++) {
        bool reached = !group->rule.liner_waits || state->reached[group->first_element + place];
        reference_constants(group, now->applied, reached, place, own + lane_offset(group, place));
    }
}

void reference_work_fill(const Model *model, const State *state, int number, const ReferenceState *now, int first,
                         int end, double *own)
{
    const ElementGroup *group = &model->groups[number];
    fill_geometry(group, state, now, first, end, own);
    for (int64_t place = (int64_t)first * BILLOW_LANES; group->erosion && place < (int64_t)end * BILLOW_LANES; place++)
        if (state->eroded[group->first_element + place]) erosion_take_out(group, own + lane_offset(group, place));
}

void reference_work_select(const Model *model, const State *state, int number, ReferenceWork *work)
{
    const ElementGroup *group = &model->groups[number];
    if (!group->has_reference && !group->erosion) return;
    work->groups[number].geometry = work->own[number]                ? work->own[number]
                                    : !state->reference[number].born ? group->mesh_geometry
                                                                     : group->geometry;
}

int reference_work_create(const Model *model, const State *state, ReferenceWork *work)
{
    *work = (ReferenceWork){.groups = model->groups};
    if (!model->has_reference && !model->has_erosion) return 0;
    size_t count = (size_t)model->group_count;
    work->groups = memory_alloc(count, sizeof *work->groups);
    work->own = memory_alloc(count, sizeof *work->own);
    int status = work->groups && work->own ? 0 : -1;
    if (!status) memcpy(work->groups, model->groups, count * sizeof *work->groups);
    for (int g = 0; !status && g < model->group_count; g++) {
        const ElementGroup *group = &model->groups[g];
        if (reference_changes_lanes(group) || group->erosion) {
            size_t size = (size_t)group->block_count * (size_t)group->geometry_size * BILLOW_LANES;
            work->own[g] = memory_alloc(size, sizeof(double));
            if (!work->own[g]) status = -1;
            if (!status)
                reference_work_fill(model, state, g, group->has_reference ? &state->reference[g] : NULL, 0,
                                    group->block_count, work->own[g]);
        }
        if (!status) reference_work_select(model, state, g, work);
    }
    if (status) reference_work_free(model, work);
    return status;
}

void reference_work_free(const Model *model, ReferenceWork *work)
{
    for (int g = 0; work->own && g < model->group_count; g++) memory_free(work->own[g]);
    memory_free(work->own);
    if (work->groups != model->groups) memory_free(work->groups);
    *work = (ReferenceWork){0};
}

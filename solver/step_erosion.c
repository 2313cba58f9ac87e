/* Erosion: elements that fail are taken out; their energy is kept in the ledger, their area opens as a hole. */
#include "solver/step_erosion.h"

#include <string.h>

#include "airbag/volume.h"
#include "elements/lane.h"
#include "solver/memory.h"

int step_erosion_allocate(Workspace *w)
{
    const Model *m = w->model;
    if (!m->has_erosion) return 0;
    w->covers = memory_alloc((size_t)m->airbag_count + 1, sizeof *w->covers);
    w->erosion_sums = memory_alloc((size_t)m->chunk_count + 1, sizeof *w->erosion_sums);
    if (!w->covers || !w->erosion_sums) return -1;
    for (int i = 0; i < m->airbag_count; i++) {
        const Airbag *bag = &m->airbags[i];
        if (bag->erodible_count == 0) continue;
        if (hole_cover_create(&w->covers[i], bag->erodible_count, bag->erodible_node, bag->erodible_slot)) return -1;
        hole_cover_update(&w->covers[i], w->state->eroded);
    }
    return 0;
}

void step_erosion_release(Workspace *w)
{
    for (int i = 0; w->covers && i < w->model->airbag_count; i++) hole_cover_free(&w->covers[i]);
    memory_free(w->covers);
    memory_free(w->erosion_sums);
}

/* What the law of a lane remembers, NULL if nothing. */
static const double *memory_of(const Workspace *w, const ElementGroup *group, int64_t place)
{
    if (law_memory_size(group->law, &group->material) == 0) return NULL;
    return w->state->history + group->history_offset +
           (place / BILLOW_LANES * group->history_size + history_size(group->point_count)) * BILLOW_LANES +
           place % BILLOW_LANES;
}

/* What the nodes got from the stress of an element over the half step after its end. Quadrilaterals with a history of
 * natural stresses have counted it. */
static double last_work(const Workspace *w, int number, int64_t place)
{
    const ElementGroup *group = &w->model->groups[number];
    double own[REFERENCE_LANE_SIZE];
    if (group->has_history && group->point_count > 1) return 0.0;
    return erosion_last_work(group, reference_lane(w->model, w->state, number, place, own), memory_of(w, group, place),
                             w->state->x, w->state->v, w->state->clock->step, place);
}

void step_erosion_chunk(Workspace *w, int number, int chunk)
{
    const ElementGroup *group = &w->reference.groups[number];
    const ErosionCriteria *criteria = group->erosion;
    ErosionSums *sums = &w->erosion_sums[chunk];
    *sums = (ErosionSums){0};
    if (!criteria) return;
    const bool over = w->state->clock->time >= criteria->end;
    const int64_t first = (int64_t)(chunk - group->first_chunk) * BILLOW_CHUNK * BILLOW_LANES;
    for (int64_t place = first; place < first + BILLOW_CHUNK * BILLOW_LANES && place < group->element_count; place++) {
        unsigned char *eroded = &w->state->eroded[group->first_element + place];
        double *lane = w->reference.own[number] + lane_offset(group, place);
        if (*eroded == EROSION_RECENT) {
            sums->work += last_work(w, number, place);
            *eroded = EROSION_DONE;
        }
        if (*eroded != EROSION_NONE) continue;
        if (!over && (criteria->active == 0 ||
                      !erosion_reached(criteria, group, lane, memory_of(w, group, place), w->state->x, place)))
            continue;
        double stored, hourglass;
        erosion_energy(group, lane, w->state->x, place, &stored, &hourglass);
        sums->stored += stored;
        sums->hourglass += hourglass;
        sums->count++;
        *eroded = EROSION_FRESH;
        erosion_take_out(group, lane);
    }
}

/* Energy at t_n of what goes stays with its part as internal energy; what is stored in the group from now on is less by
 * it. */
static int64_t keep_energy(Workspace *w)
{
    const Model *m = w->model;
    int64_t count = 0;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        for (int c = 0; group->erosion && c < (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK; c++) {
            const ErosionSums *sums = &w->erosion_sums[group->first_chunk + c];
            w->state->part_energy[group->part] += sums->work;
            if (sums->count == 0) continue;
            count += sums->count;
            w->state->group_energy[g] -= sums->stored;
            w->state->part_hourglass[group->part] -= sums->hourglass;
            w->state->part_energy[group->part] += sums->hourglass;
        }
    }
    return count;
}

/* The holes of one bag: their area at this moment goes to the eroded area of their part, the volume below them from the
 * walls to the covers (eq. X9, X10). */
static void open_holes(Workspace *w, int airbag)
{
    const Model *m = w->model;
    const Airbag *bag = &m->airbags[airbag];
    const HoleCover *cover = &w->covers[airbag];
    for (int f = 0; f < cover->facet_count; f++) {
        if (w->state->eroded[cover->element[f]] != EROSION_FRESH) continue;
        const int32_t *node = cover->node + 4 * (ptrdiff_t)f;
        const int group = lane_group(m, cover->element[f]);
        const int place = m->group_place[(ptrdiff_t)group * m->airbag_count + airbag];
        w->state->cap_volume[airbag] += volume_facet(node, w->state->x, m->origin);
        if (place >= 0) w->state->part_eroded[bag->first_part + place] += volume_facet_area(node, w->state->x);
    }
    hole_cover_update(&w->covers[airbag], w->state->eroded);
}

static void settle(Workspace *w)
{
    const Model *m = w->model;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        for (int c = 0; group->erosion && c < (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK; c++) {
            if (w->erosion_sums[group->first_chunk + c].count == 0) continue;
            unsigned char *eroded =
                w->state->eroded + group->first_element + (ptrdiff_t)c * BILLOW_CHUNK * BILLOW_LANES;
            for (int i = 0; i < BILLOW_CHUNK * BILLOW_LANES; i++) {
                if (c * BILLOW_CHUNK * BILLOW_LANES + i >= group->element_count) break;
                if (eroded[i] == EROSION_FRESH) eroded[i] = EROSION_RECENT;
            }
        }
    }
}

void step_erosion_close(Workspace *w)
{
    const int64_t count = keep_energy(w);
    if (count == 0) return;
    *w->state->eroded_count += count;
    for (int i = 0; i < w->model->airbag_count; i++)
        if (w->covers[i].facet_count > 0) open_holes(w, i);
    settle(w);
}

double step_erosion_cover(const Workspace *w, int airbag)
{
    return w->covers ? hole_cover_volume(&w->covers[airbag], w->state->x, w->model->origin) : 0.0;
}

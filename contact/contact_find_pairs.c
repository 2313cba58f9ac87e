/* Broad phase: which groups of nodes may meet which groups of triangles, and which groups of edges which, before two
 * nodes can have come nearer by the skin. */
#include <math.h>
#include <string.h>

#include "contact/contact_grid.h"
#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "contact/contact_sides.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* What nodes behind a surface may sink further until a search is due, as a share of their radius. */
#define ALLOWED 0.5

/* Distance of two boxes. */
static double boxes_apart(const ContactBox *a, const ContactBox *b)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        double gap = larger(larger(a->low[k] - b->high[k], b->low[k] - a->high[k]), 0.0);
        square += gap * gap;
    }
    return sqrt(square);
}

/* A thread's share of the boxes around groups. */
static void place_groups(ContactLoop *loop, ContactRun *run, int thread, int threads)
{
    const double *x = loop->skin.from;
    ContactGroups *all[3] = {&run->nodes, &run->triangles, &run->lines};
    for (int k = 0; k < 3; k++) {
        int first = contact_first_of(all[k]->count, thread, threads),
            end = contact_first_of(all[k]->count, thread + 1, threads);
        contact_groups_place(all[k], x, loop->skin.of, first, end);
        loop->motion_kernels->follow(all[k], loop->state->v, first, end);
        contact_groups_unwatch(all[k], first, end);
    }
}

/* Sorts the boxes around groups. */
static int fill_grid(ContactLoop *loop, const ContactGroups *groups)
{
    if (memory_reserve((void **)&loop->box, &loop->box_capacity, (size_t)groups->count + 1, sizeof *loop->box))
        return -1;
    for (int h = 0; h < groups->count; h++) {
        loop->box[h] = groups->box[h];
        contact_box_grow(&loop->box[h], groups->radius[h] + groups->skin[h]);
    }
    return contact_grid_fill(&loop->grid, loop->box, groups->count);
}

/* Pairs of a thread's share of the groups of owners. In one kind (own == all) each pair is found once. */
static void find_groups(ContactLoop *loop, ContactList *list, const ContactGroups *own, const ContactGroups *all,
                        int thread, int threads)
{
    ContactPart *part = &loop->parts[thread];
    part->pair_count = 0;
    part->failed = false;
    for (int g = contact_first_of(own->count, thread, threads); g < contact_first_of(own->count, thread + 1, threads);
         g++) {
        ContactBox box = own->box[g];
        size_t first = part->pair_count;
        list->next_start[g] = (int32_t)first;
        list->allowed[g] = own == all ? 0.0 : list->deepest[g] + ALLOWED * own->radius[g];
        contact_box_grow(&box, own->radius[g] + own->skin[g] + list->allowed[g]);
        int found = contact_grid_query(&loop->grid, &box, &part->found);
        part->failed = found < 0 || contact_part_reserve(part, (size_t)found, all->count);
        for (int k = 0; k < found && !part->failed; k++) {
            int h = part->found.item[k];
            if ((own == all && h < g) || !contact_groups_meet(own, g, all, h)) continue;
            double slack = boxes_apart(&own->box[g], &all->box[h]) - own->radius[g] - all->radius[h];
            if (slack <= own->skin[g] + all->skin[h] + list->allowed[g]) contact_part_add(part, h, slack);
        }
        if (part->failed) return;
        contact_pairs_remember(list, g, part, first);
    }
}

/* The velocities of groups in pairs are kept from now on. */
static void watch(const ContactList *list, ContactGroups *own, ContactGroups *all)
{
    for (int g = 0; g < list->group_count; g++)
        for (int32_t k = list->start[g]; k < list->start[g + 1]; k++)
            own->watched[g] = all->watched[list->pairs.other[k]] = 1;
}

/* One contact; all threads of the team, which part the work between barriers. */
static void find_pairs(ContactLoop *loop, ContactRun *run, int thread, Team *team)
{
    int threads = team_size(team), edges = run->contact->edge_count;
    place_groups(loop, run, thread, threads);
    team_barrier(team);
    if (thread == 0 && fill_grid(loop, &run->triangles)) loop->out_of_memory = true;
    team_barrier(team);
    if (loop->out_of_memory) return;
    find_groups(loop, &run->faces, &run->nodes, &run->triangles, thread, threads);
    team_barrier(team);
    if (thread == 0) {
        if (contact_pairs_join(loop, &run->faces, threads) || (edges > 0 && fill_grid(loop, &run->lines)))
            loop->out_of_memory = true;
        else
            watch(&run->faces, &run->nodes, &run->triangles);
    }
    if (edges == 0) return;
    team_barrier(team);
    if (loop->out_of_memory) return;
    find_groups(loop, &run->edges, &run->lines, &run->lines, thread, threads);
    team_barrier(team);
    if (thread != 0) return;
    if (contact_pairs_join(loop, &run->edges, threads))
        loop->out_of_memory = true;
    else
        watch(&run->edges, &run->lines, &run->lines);
}

void contact_find_pairs(ContactLoop *loop, int thread, Team *team)
{
    team_barrier(team); /* for the positions */
    for (int i = 0; i < loop->model->contact_count; i++) find_pairs(loop, &loop->runs[i], thread, team);
    team_barrier(team);
    for (int i = 0; thread == 0 && loop->out_of_memory && i < loop->model->contact_count; i++) {
        loop->runs[i].alive = false;
        contact_pairs_forget(&loop->runs[i].faces);
        contact_pairs_forget(&loop->runs[i].edges);
    }
}

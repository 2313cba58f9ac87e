/* What follows the surface's shape a little late: which edges are sharp, and the room of its nodes (docs/theory.md,
 * Contact). */
#include <string.h>

#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"

/* Cycles from look to look at the edges, and looks from room to room. */
enum { SHARP_CYCLES = 2, ROOM_LOOKS = 8 };

/* Each thread its share of the nodes. */
static void keep_positions(ContactLoop *loop, int thread, int threads)
{
    int32_t first = contact_first_of(loop->model->node_count, thread, threads),
            end = contact_first_of(loop->model->node_count, thread + 1, threads);
    memcpy(loop->state->contact_formed + 3 * (ptrdiff_t)first, loop->state->x + 3 * (ptrdiff_t)first,
           3 * (size_t)(end - first) * sizeof(double));
}

void contact_renew(ContactLoop *loop, int thread, Team *team)
{
    ContactClock *clock = loop->state->contact;
    int threads = team_size(team);
    bool first = !clock->started, room = first || clock->looks + 1 >= ROOM_LOOKS;
    if (!first && clock->unseen < SHARP_CYCLES) return;
    for (int i = 0; i < loop->model->contact_count; i++)
        contact_sharp_planes(&loop->runs[i], loop->state->x, thread, threads);
    if (room) keep_positions(loop, thread, threads);
    team_barrier(team); /* all have read the clock, too */
    if (thread == 0) {
        clock->started = 1;
        clock->unseen = 0;
        clock->looks = room ? 0 : clock->looks + 1;
    }
    for (int i = 0; i < loop->model->contact_count; i++) contact_sharp_mark(loop, &loop->runs[i], thread, threads);
    if (room) contact_fill_room(loop, thread, threads);
}

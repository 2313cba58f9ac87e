/* A team of threads with a sense-counting barrier: spin, then yield, then sleep. */
#define _GNU_SOURCE
#include "solver/team.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <time.h>

#include "solver/billow.h"
#include "solver/memory.h"

struct Team {
    _Alignas(64) atomic_int arrived;
    _Alignas(64) atomic_uint phase;
    _Alignas(64) int size;
    int spins; /* polls before yielding: few when there are more threads than processors */
    TeamWork *work;
    void *context;
};

typedef struct Member {
    Team *team;
    int thread;
    pthread_t handle;
} Member;

int team_size(const Team *team)
{
    return team->size;
}

void team_barrier(Team *team)
{
    if (team->size == 1) return;
    unsigned phase = atomic_load_explicit(&team->phase, memory_order_relaxed);
    if (atomic_fetch_add_explicit(&team->arrived, 1, memory_order_acq_rel) == team->size - 1) {
        atomic_store_explicit(&team->arrived, 0, memory_order_relaxed);
        atomic_store_explicit(&team->phase, phase + 1, memory_order_release);
        return;
    }
    for (int i = 0; atomic_load_explicit(&team->phase, memory_order_acquire) == phase; i++) {
        if (i < team->spins) {
            __builtin_ia32_pause();
        } else if (i < team->spins + 2000) {
            sched_yield();
        } else {
            struct timespec nap = {0, 50000};
            nanosleep(&nap, NULL);
        }
    }
}

static void *run_member(void *argument)
{
    Member *member = argument;
    /* The start waits until the team's size is known. */
    while (atomic_load_explicit(&member->team->phase, memory_order_acquire) == 0) sched_yield();
    if (member->thread < member->team->size) member->team->work(member->team->context, member->thread, member->team);
    return NULL;
}

int team_run(int *count, TeamWork *work, void *context)
{
    Team *team = memory_alloc(1, sizeof *team);
    Member *members = memory_alloc((size_t)*count, sizeof *members);
    if (!team || !members) {
        memory_free(team);
        memory_free(members);
        return -1;
    }
    cpu_set_t processors;
    int available = sched_getaffinity(0, sizeof processors, &processors) == 0 ? CPU_COUNT(&processors) : 1;
    int started = 1;
    team->work = work;
    team->context = context;
    for (; started < *count; started++) {
        members[started] = (Member){.team = team, .thread = started};
        if (pthread_create(&members[started].handle, NULL, run_member, &members[started])) break;
    }
    *count = team->size = started;
    team->spins = started <= available ? 4000 : 0;
    atomic_store_explicit(&team->phase, 1, memory_order_release);
    work(context, 0, team);
    for (int i = 1; i < started; i++) pthread_join(members[i].handle, NULL);
    memory_free(team);
    memory_free(members);
    return 0;
}

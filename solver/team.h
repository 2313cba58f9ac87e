/* A team of threads that walk through one function together, with a barrier between its phases. */
#ifndef BILLOW_TEAM_H
#define BILLOW_TEAM_H

typedef struct Team Team;

/* What every thread runs; thread 0 is the caller. */
typedef void TeamWork(void *context, int thread, Team *team);

/* Runs work on count threads (1 to BILLOW_MAX_THREADS) and returns when all have. Fewer threads are used if the system
 * refuses some; *count receives how many. 0, or -1 without memory. */
int team_run(int *count, TeamWork *work, void *context);

/* Waits for all threads of the team. Spins briefly, then yields, then sleeps, so that a busy machine stays usable. */
void team_barrier(Team *team);

int team_size(const Team *team);

#endif

/* rwforc: force of each rigid wall on the nodes over time; the normal force is positive where the wall pushes. */
#include "io/results_files.h"

const HistoryFormat results_rwforc_format = {"rwforc.csv", "time,wall,normal_force,fx,fy,fz", "rwforc", "    time "};

int results_write_rwforc(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_RWFORC];
    double time = state->clock->time;
    if (model->wall_count == 0) return 0;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    fprintf(history->ascii.stream, "    time       wall#   normal-force    x-force        y-force        z-force\n");
    for (int i = 0; i < model->wall_count; i++) {
        const double *force = view->wall_force + 4 * (ptrdiff_t)i;
        fprintf(history->csv.stream, "%.17g,%d,%.17g,%.17g,%.17g,%.17g\n", time, model->walls[i].id, force[3], force[0],
                force[1], force[2]);
        fprintf(history->ascii.stream, "%12.5E%8d%15.6E%15.6E%15.6E%15.6E\n", time, model->walls[i].id,
                history_clip(force[3]), history_clip(force[0]), history_clip(force[1]), history_clip(force[2]));
    }
    return history_commit(history, time);
}

/* gceout: force and moment on each contact entity over time, about its body's centre or, of a fixed part, its origin.
 */
#include "io/results_files.h"

const HistoryFormat results_gceout_format = {"gceout.csv", "time,entity,part,fx,fy,fz,mx,my,mz", NULL, NULL};

int results_write_gceout(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_GCEOUT];
    double time = state->clock->time;
    if (model->entity_count == 0 || !view->entity) return 0;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    for (int i = 0; i < model->entity_count; i++) {
        const double *f = view->entity + 6 * (ptrdiff_t)i;
        fprintf(history->csv.stream, "%.17g,%d,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", time, model->entities[i].id,
                model->entities[i].part_id, f[0], f[1], f[2], f[3], f[4], f[5]);
    }
    return history_commit(history, time);
}

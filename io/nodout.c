/* nodout: motion of the nodes named by *DATABASE_HISTORY_NODE over time. */
#include <inttypes.h>

#include "io/results_files.h"

const HistoryFormat results_nodout_format = {"nodout.csv", "time,node,x,y,z,ux,uy,uz,vx,vy,vz,ax,ay,az", "nodout",
                                             " n o d a l   p r i n t   o u t"};

int results_write_nodout(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_NODOUT];
    double time = state->clock->time;
    if (model->output.history_count == 0) return 0;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    FILE *csv = history->csv.stream, *ascii = history->ascii.stream;
    fprintf(ascii,
            "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p%8" PRId64
            "                              ( at time%14.7E )\n",
            state->clock->cycle, time);
    fprintf(ascii, "\n nodal point  x-disp     y-disp      z-disp      x-vel       y-vel       z-vel      x-accl      "
                   "y-accl      z-accl      x-coor      y-coor      z-coor\n");
    for (int i = 0; i < model->output.history_count; i++) {
        int node = model->output.history_node[i];
        const double *x = view->x + 3 * (ptrdiff_t)node, *start = model->initial + 3 * (ptrdiff_t)node;
        const double *v = view->v + 3 * (ptrdiff_t)node, *a = view->a + 3 * (ptrdiff_t)node;
        const double u[3] = {x[0] - start[0], x[1] - start[1], x[2] - start[2]};
        const double *const in_ascii[4] = {u, v, a, x}, *const in_csv[4] = {x, u, v, a};
        fprintf(csv, "%.17g,%d", time, model->node_id[node]);
        fprintf(ascii, "%9d ", model->node_id[node]);
        for (int j = 0; j < 12; j++) {
            fprintf(csv, ",%.17g", in_csv[j / 3][j % 3]);
            fprintf(ascii, "%12.4E", history_clip(in_ascii[j / 3][j % 3]));
        }
        fprintf(csv, "\n");
        fprintf(ascii, "\n");
    }
    return history_commit(history, time);
}

/* rcforc: resultant contact forces on both sides of each contact over time. */
#include "io/results_files.h"

const HistoryFormat results_rcforc_format = {"rcforc.csv", "time,interface,side,fx,fy,fz", "rcforc", " \n"};

static void write_legend(FILE *ascii, const Model *model)
{
    fprintf(ascii, "\n{BEGIN LEGEND}\n Entity #        Title\n");
    for (int i = 0; i < model->contact_count; i++)
        fprintf(ascii, "%9d     %-70.70s\n", model->contacts[i].id, model->contacts[i].title);
    fprintf(ascii, "{END LEGEND}\n\n");
}

static void write_side(FILE *ascii, const char *side, int id, double time, const double *force, double sign)
{
    double f[3];
    for (int k = 0; k < 3; k++) f[k] = history_clip(sign * force[k]);
    fprintf(ascii, " %-6s%11d time %11.5E  x %12.5E  y %12.5E  z %12.5E mass %12.5E\n", side, id, history_clip(time),
            f[0], f[1], f[2], 0.0);
}

int results_write_rcforc(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_RCFORC];
    double time = state->clock->time;
    if (model->contact_count == 0 || !view->resultant) return 0;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    FILE *csv = history->csv.stream, *ascii = history->ascii.stream;
    if (history->ascii.fresh) write_legend(ascii, model);
    fputs(" \n", ascii); /* by which a restart tells the blocks apart */
    for (int i = 0; i < model->contact_count; i++) {
        const double *f = view->resultant + 3 * (ptrdiff_t)i;
        for (int side = 1; side <= 2; side++) {
            double sign = side == 1 ? 1.0 : -1.0;
            fprintf(csv, "%.17g,%d,%d,%.17g,%.17g,%.17g\n", time, model->contacts[i].id, side, sign * f[0] + 0.0,
                    sign * f[1] + 0.0, sign * f[2] + 0.0);
            write_side(ascii, side == 1 ? "slave" : "master", model->contacts[i].id, time, f, sign);
        }
    }
    return history_commit(history, time);
}

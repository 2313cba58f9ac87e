/* abstat and abstat_parts: the gas of each control volume and the parts on its surface over time. */
#include <math.h>

#include "io/results_files.h"

const HistoryFormat results_abstat_format = {
    "abstat.csv",
    "time,airbag,volume,pressure,internal_energy,mass_flow_in,density,mass_flow_out,mass,temperature,area,reaction,"
    "mass_flow_out_porosity,mass_flow_out_vent",
    "abstat", "      time   airbag/cv #"};

const HistoryFormat results_abstat_parts_format = {
    "abstat_parts.csv", "time,airbag,part,unblocked_area,blocked_area,mass_flow_out", NULL, NULL};

/* Size of an element's area vector, half the cross product of its diagonals, as in the bag's own area; a triangle's
 * fourth corner repeats its third. */
static double element_area(const double *x, const int32_t *node)
{
    double u[3], w[3];
    for (int i = 0; i < 3; i++) {
        u[i] = x[3 * (ptrdiff_t)node[2] + i] - x[3 * (ptrdiff_t)node[0] + i];
        w[i] = x[3 * (ptrdiff_t)node[3] + i] - x[3 * (ptrdiff_t)node[1] + i];
    }
    double n0 = u[1] * w[2] - u[2] * w[1], n1 = u[2] * w[0] - u[0] * w[2], n2 = u[0] * w[1] - u[1] * w[0];
    return 0.5 * sqrt(n0 * n0 + n1 * n1 + n2 * n2);
}

/* Current area of every part [L2] into area (part_count). */
static void sum_part_areas(const Model *model, const double *x, double *area)
{
    for (int p = 0; p < model->part_count; p++) area[p] = 0;
    for (int e = 0; e < model->element_count; e++)
        area[model->element_part[e]] += element_area(x, model->element_node + 4 * (ptrdiff_t)e);
}

static void write_legend(FILE *ascii, const Model *model)
{
    fprintf(ascii, "\n{BEGIN LEGEND}\n Entity #        Title\n");
    for (int k = 0; k < model->airbag_count; k++)
        fprintf(ascii, "%9d     %-70.70s\n", model->airbags[k].id, model->airbags[k].heading);
    fprintf(ascii, "{END LEGEND}\n\n");
}

static void write_row(FILE *csv, double time, int id, const GasState *gas)
{
    fprintf(csv, "%.17g,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", time, id,
            gas->volume, gas->pressure, gas->energy, gas->mass_flow_in, gas->density, gas->mass_flow_out, gas->mass,
            gas->temperature, gas->area, gas->reaction, gas->mass_flow_out_porosity, gas->mass_flow_out_vent);
}

static void write_ascii_row(FILE *ascii, double time, const Model *model, const Airbag *bag, const GasState *gas,
                            const double *area)
{
    const double wide[5] = {gas->volume, gas->pressure, gas->energy, gas->mass_flow_in, gas->density};
    const double narrow[7] = {
        gas->mass_flow_out,     gas->mass, gas->temperature, gas->area, gas->reaction, gas->mass_flow_out_porosity,
        gas->mass_flow_out_vent};
    fprintf(ascii, "%12.5E%8d", time, bag->id);
    for (int i = 0; i < 5; i++) fprintf(ascii, "%15.4E", history_clip(wide[i]));
    for (int i = 0; i < 7; i++) fprintf(ascii, "%11.3E", history_clip(narrow[i]));
    fprintf(ascii, "\n");
    for (int i = 0; i < bag->part_count; i++)
        fprintf(ascii,
                "    Material I.D.=%12d  Unblocked  Area=%12.4E    Blocked  Area=%12.4E    Leakage      =%12.4E\n",
                model->parts[bag->part[i]].id, history_clip(area[bag->part[i]]), 0.0, 0.0);
}

/* Surface shares: nothing is blocked and no fabric leaks by itself; vents and porosity areas belong to the bag. */
static int write_parts(Results *results, const Model *model, double time)
{
    History *history = &results->history[HISTORY_ABSTAT_PARTS];
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    for (int k = 0; k < model->airbag_count; k++) {
        const Airbag *bag = &model->airbags[k];
        for (int i = 0; i < bag->part_count; i++)
            fprintf(history->csv.stream, "%.17g,%d,%d,%.17g,0,0\n", time, bag->id, model->parts[bag->part[i]].id,
                    results->part_area[bag->part[i]]);
    }
    return history_commit(history, time);
}

int results_write_abstat(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_ABSTAT];
    double time = state->clock->time;
    if (model->airbag_count == 0) return 0;
    sum_part_areas(model, view->x, results->part_area);
    if (write_parts(results, model, time)) return -1;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    if (history->ascii.fresh) write_legend(history->ascii.stream, model);
    fprintf(
        history->ascii.stream,
        "\n\n      time   airbag/cv #  volume        pressure    internal energy      dm/dt in      density dm/dt out"
        "  total mass gas temp. surface area   reaction dm/dt outp dm/dt outv\n");
    for (int k = 0; k < model->airbag_count; k++) {
        write_row(history->csv.stream, time, model->airbags[k].id, &state->gas[k]);
        write_ascii_row(history->ascii.stream, time, model, &model->airbags[k], &state->gas[k], results->part_area);
    }
    return history_commit(history, time);
}

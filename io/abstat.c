/* abstat and abstat_parts: the gas of each control volume and the parts on its surface over time. */
#include <math.h>

#include "airbag/gas_vent.h"
#include "io/results_files.h"

const HistoryFormat results_abstat_format = {
    "abstat.csv",
    "time,airbag,volume,pressure,internal_energy,mass_flow_in,density,mass_flow_out,mass,temperature,area,reaction,"
    "mass_flow_out_porosity,mass_flow_out_vent",
    "abstat", "      time   airbag/cv #"};

const HistoryFormat results_abstat_parts_format = {
    "abstat_parts.csv", "time,airbag,part,unblocked_area,blocked_area,mass_flow_out", NULL, NULL};

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

/* What leaves through each part of a bag now; flow (2 x part_count) has workspace behind it. */
static void find_flows(const Model *model, const State *state, int k, double time, double *flow)
{
    const Airbag *bag = &model->airbags[k];
    GasAreas areas = {state->part_area + bag->first_part, state->part_blocked + bag->first_part,
                      model->has_erosion ? state->part_eroded + bag->first_part : NULL};
    gas_part_flows(&bag->gas, model->curves, &areas, &state->gas[k], time, bag->part_count, flow + bag->part_count,
                   flow);
}

static void write_ascii_row(FILE *ascii, double time, const Model *model, const Airbag *bag, const GasState *gas,
                            const State *state, const double *flow)
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
                model->parts[bag->part[i]].id,
                history_clip(state->part_area[bag->first_part + i] - state->part_blocked[bag->first_part + i]),
                history_clip(state->part_blocked[bag->first_part + i]), history_clip(flow[i]));
}

/* Areas, and what leaks through the fabric of each part or leaves through it as a vent. */
static int write_parts(Results *results, const Model *model, const State *state, double time)
{
    History *history = &results->history[HISTORY_ABSTAT_PARTS];
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    for (int k = 0; k < model->airbag_count; k++) {
        const Airbag *bag = &model->airbags[k];
        find_flows(model, state, k, time, results->part_flow);
        for (int i = 0; i < bag->part_count; i++) {
            double blocked = state->part_blocked[bag->first_part + i];
            fprintf(history->csv.stream, "%.17g,%d,%d,%.17g,%.17g,%.17g\n", time, bag->id,
                    model->parts[bag->part[i]].id, state->part_area[bag->first_part + i] - blocked, blocked,
                    results->part_flow[i]);
        }
    }
    return history_commit(history, time);
}

int results_write_abstat(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_ABSTAT];
    double time = state->clock->time;
    if (model->airbag_count == 0) return 0;
    (void)view;
    if (write_parts(results, model, state, time)) return -1;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    if (history->ascii.fresh) write_legend(history->ascii.stream, model);
    fprintf(
        history->ascii.stream,
        "\n\n      time   airbag/cv #  volume        pressure    internal energy      dm/dt in      density dm/dt out"
        "  total mass gas temp. surface area   reaction dm/dt outp dm/dt outv\n");
    for (int k = 0; k < model->airbag_count; k++) {
        write_row(history->csv.stream, time, model->airbags[k].id, &state->gas[k]);
        find_flows(model, state, k, time, results->part_flow);
        write_ascii_row(history->ascii.stream, time, model, &model->airbags[k], &state->gas[k], state,
                        results->part_flow);
    }
    return history_commit(history, time);
}

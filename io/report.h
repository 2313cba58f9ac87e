/* The report of an accepted deck: the text of billow check and of the log. */
#ifndef BILLOW_REPORT_H
#define BILLOW_REPORT_H

#include <stdio.h>

#include "solver/definitions.h"
#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/state.h"

/* How many items of each keyword the deck has. */
void report_write_keywords(const Definitions *definitions, FILE *stream);

/* Nodes, elements, parts with material, thickness, area and mass; moving rigid bodies. */
void report_write_parts(const Model *model, FILE *stream);

/* Parts with a reference geometry: areas and masses by both geometries, and what holds when; nothing without one. */
void report_write_reference(const Model *model, FILE *stream);

/* Each bag's surface (orientation, free edges, caps with their place), volume and gas at the state. */
void report_write_airbags(const Model *model, const State *state, FILE *stream);

/* Each contact, with nodes that are too near at the start and edges that go through surfaces. */
void report_write_contacts(const Model *model, Diagnostics *diagnostics, FILE *stream);

/* Supports, prescribed motion, loads, hanging nodes. */
void report_write_conditions(const Model *model, FILE *stream);

/* Rigid walls with the numbers of their nodes; nothing without one. */
void report_write_walls(const Model *model, FILE *stream);

/* Which rigid parts are closed and convex, and which of these lie in each other. 0, or -1 without memory. */
int report_write_rigid_shapes(const Model *model, FILE *stream);

/* Shells of which at least one is deformable and that go through each other without sharing a node, at the deck's
 * coordinates: how many pairs, the deepest and its place. 0, or -1 without memory. */
int report_write_crossings(const Model *model, FILE *stream);

/* The stable step of the deck: the limit smallest elements in their reference state, mass added by DT2MS. */
void report_write_steps(const Model *model, int limit, FILE *stream);

/* End time and output intervals. */
void report_write_plan(const Model *model, const OutputPlan *plan, FILE *stream);

/* All messages that were collected, under a heading of their own. */
void report_write_messages(const Diagnostics *diagnostics, FILE *stream);

#endif

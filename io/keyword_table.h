/* The table of all keywords: names, options, cards, fields and their use. The readers, docs/keywords.md and the test
 * that compares the two all work from this one table. */
#ifndef BILLOW_KEYWORD_TABLE_H
#define BILLOW_KEYWORD_TABLE_H

#include <stdio.h>

#include "io/card.h"

enum { KEYWORD_MAX_OPTIONS = 8, KEYWORD_MAX_ALIASES = 3 };

/* One card: its fields, and when it is there ("" = always). */
typedef struct CardSpec {
    const char *name; /* "card 1", "card 4a", as messages and the manual page call it */
    const char *when; /* condition in words, "" if always */
    const FieldSpec *fields;
    int count;
} CardSpec;

typedef enum KeywordState {
    KEYWORD_READ,    /* has a reader */
    KEYWORD_IGNORED, /* steers output or numerics only: skipped with a note */
    KEYWORD_REFUSED, /* known and not there: an error that says what to use in its place */
    KEYWORD_LOADED,  /* used up by the loader (io/card.h): parameters, includes, transformations */
} KeywordState;

struct KeywordRead;

typedef struct KeywordSpec {
    const char *name; /* "*MAT_FABRIC", without options */
    KeywordState state;
    const char *aliases[KEYWORD_MAX_ALIASES]; /* other spellings, NULL where none */
    const char *options[KEYWORD_MAX_OPTIONS]; /* in any order after the name: "TITLE", "BIRTH_DEATH"; NULL at the end */
    const CardSpec *cards;
    int card_count;
    void (*read)(struct KeywordRead *read); /* NULL unless state is KEYWORD_READ */
    const char *remark;                     /* what a user must know; the reason if it is ignored; "" if nothing */
    bool prefix; /* any further words after the name belong to it (families that are ignored as a whole) */
} KeywordSpec;

/* One group of keywords, defined by one io/keyword_<name>.c. */
typedef struct KeywordFamily {
    const char *title;
    const KeywordSpec *specs;
    int count;
} KeywordFamily;

/* One block being read: what a reader gets. Readers append to definitions and report to cards->diagnostics. */
typedef struct KeywordRead {
    const KeywordSpec *spec;
    unsigned options; /* bit i: spec->options[i] is part of the keyword */
    CardReader *cards;
    Definitions *definitions;
    bool out_of_memory; /* set once; reading of the deck then ends */
    bool kept; /* errors were reported, and yet the record is there: the rest of the deck can be checked against it */
} KeywordRead;

extern const KeywordFamily keyword_family_nodes, keyword_family_parts, keyword_family_materials, keyword_family_fabric,
    keyword_family_rubber, keyword_family_orthotropic, keyword_family_sets, keyword_family_curves,
    keyword_family_functions, keyword_family_coordinates, keyword_family_control, keyword_family_database,
    keyword_family_boundary, keyword_family_initial, keyword_family_load, keyword_family_airbag_laws,
    keyword_family_airbag_hybrid, keyword_family_porosity, keyword_family_airbag_connection, keyword_family_damping,
    keyword_family_airbag, keyword_family_deck, keyword_family_ignored, keyword_family_refused,
    keyword_family_rigidwall, keyword_family_solids, keyword_family_rigid_bodies, keyword_family_links,
    keyword_family_seatbelt, keyword_family_reference_geometry, keyword_family_seams, keyword_family_erosion,
    keyword_family_contact, keyword_family_contact_entity, keyword_family_masses, keyword_family_springs;

/* Cards of a rigid body's inertia, in *PART_INERTIA and *CONSTRAINED_NODAL_RIGID_BODY_INERTIA, for records of
 * InertiaCard; the reading of them all returns 0, or -1 after an error. */
extern const FieldSpec keyword_inertia_centre[6], keyword_inertia_tensor[6], keyword_inertia_rates[6],
    keyword_inertia_axes[7];
#define KEYWORD_INERTIA_CARDS                                                                                          \
    {"card 3", "with INERTIA", keyword_inertia_centre, 6}, {"card 4", "with INERTIA", keyword_inertia_tensor, 6},      \
        {"card 5", "with INERTIA", keyword_inertia_rates, 6},                                                          \
    {                                                                                                                  \
        "card 6", "with INERTIA, if IRCS = 1", keyword_inertia_axes, 7                                                 \
    }
int keyword_read_inertia(KeywordRead *read, InertiaCard *inertia);

/* All families in the order of the documentation. */
int keyword_family_count(void);
const KeywordFamily *keyword_family(int index);

/* The entry for a keyword as written ("*AIRBAG_WANG_NEFSKE_ID") and the options found in it; NULL if there is none.
 * Then *base is the entry with the longest matching name and *rest the words after it that are no options (a pointer
 * into keyword), or NULL where not even the name is known. */
const KeywordSpec *keyword_find(const char *keyword, unsigned *options, const KeywordSpec **base, const char **rest);

/* The known keyword whose spelling is nearest, or NULL if none differs by two letters or fewer. */
const char *keyword_nearest(const char *keyword);

/* docs/keywords.md as the table says. */
void keyword_print_documentation(FILE *stream);

/* --- for the readers --- */

/* True if the option at this place of spec->options was given. */
bool keyword_option(const KeywordRead *read, int option);

/* Reads card number card (index into spec->cards) into record. As card_read. */
int keyword_card(KeywordRead *read, int card, void *record, bool required, Source *source);

/* True while cards with content are left (blank lines at the end do not count). */
bool keyword_more(const KeywordRead *read);

/* Appends a zeroed record to a LIST and returns it, NULL without memory (reported). Use KEYWORD_APPEND. */
void *keyword_append(KeywordRead *read, void **items, size_t *count, size_t *capacity, size_t size);
#define KEYWORD_APPEND(read, list)                                                                                     \
    keyword_append((read), (void **)&(list).items, &(list).count, &(list).capacity, sizeof *(list).items)

/* Error or warning at a card of the keyword being read. */
void keyword_error(const KeywordRead *read, Source source, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void keyword_warning(const KeywordRead *read, Source source, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void keyword_note(const KeywordRead *read, Source source, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Reports an id that is not positive under the field's name; returns whether it is positive. */
bool keyword_check_id(const KeywordRead *read, int id, const char *field, Source source);

/* Warns of a thing (such as "contact") that ends, by the fields named, before it begins. */
void keyword_check_times(const KeywordRead *read, const char *thing, const char *begin_field, double begin,
                         const char *end_field, double end, Source source);

/* Reads the title card if the option (place in spec->options) was given; title: BILLOW_TITLE_LENGTH bytes. */
void keyword_title(KeywordRead *read, int option, char *title);

/* Reads the ID card (I10, A70) if the option was given; id and title may be NULL. */
void keyword_id_card(KeywordRead *read, int option, int *id, char *title);

/* Error if cards with content are left after the last one known. */
void keyword_finish(KeywordRead *read);

/* A value with *INCLUDE_TRANSFORM's offset or factor, for fields whose meaning (id or quantity) depends on their sign
 * or on another field. Ids: 0 stays 0, a negative id keeps its sign. */
double keyword_scale(const KeywordRead *read, double value, FieldScale scale);

/* The same for an id that stands in a real column, perhaps with a sign; false and an error under the field's name
 * unless it is whole and in the range of int. */
bool keyword_real_id(const KeywordRead *read, double *value, FieldScale scale, const char *field, Source source);

/* Checks FVOPT and turns negative FLC, FAC and ELA into ids of curves; false after reporting. */
bool keyword_check_leakage(const KeywordRead *read, double *flc, double *fac, double *ela, double fvopt, double x0,
                           double x1, Source source);

/* Position or direction by *DEFINE_TRANSFORMATION's matrix (nothing without one). */
void keyword_transform_point(const KeywordRead *read, double x[3]);
void keyword_transform_vector(const KeywordRead *read, double x[3]);

/* True if the include's transformation rotates or shears: what is bound to the global axes then cannot follow. */
bool keyword_transform_turns(const KeywordRead *read);

/* Errors for ids used twice, naming both lines; the later records are taken out of the definitions. O(n log n). */
void keyword_check_duplicates(Definitions *definitions, Diagnostics *diagnostics);

/* Checks between keywords that need no geometry; NPLTC becomes an interval. */
void keyword_check_references(Definitions *definitions, Diagnostics *diagnostics);

/* Field tables. AT(member) must be defined as the offset of member in the card's record. */
#define CARD_INT(name, member, use, scale)                                                                             \
    {                                                                                                                  \
        name, 'I', 10, AT(member), 0.0, false, FIELD_##use, SCALE_##scale                                              \
    }
#define CARD_INT_OR(name, member, fallback, use, scale)                                                                \
    {                                                                                                                  \
        name, 'I', 10, AT(member), fallback, true, FIELD_##use, SCALE_##scale                                          \
    }
#define CARD_REAL(name, member, use, scale)                                                                            \
    {                                                                                                                  \
        name, 'F', 10, AT(member), 0.0, false, FIELD_##use, SCALE_##scale                                              \
    }
#define CARD_REAL_OR(name, member, fallback, use, scale)                                                               \
    {                                                                                                                  \
        name, 'F', 10, AT(member), fallback, true, FIELD_##use, SCALE_##scale                                          \
    }
#define CARD_TEXT(name, member, columns, use)                                                                          \
    {                                                                                                                  \
        name, 'A', columns, AT(member), 0.0, false, FIELD_##use, SCALE_NONE                                            \
    }
#define CARD_GAP                                                                                                       \
    {                                                                                                                  \
        "-", '-', 10, 0, 0.0, false, FIELD_USED, SCALE_NONE                                                            \
    }
#define CARD_FIELDS(fields) fields, (int)(sizeof(fields) / sizeof *(fields))

/* Where the values of fields go that billow reads only to list them. */
typedef struct UnusedCard {
    int i[10];
    double f[10];
    char text[81];
} UnusedCard;
#define UNUSED_INT(name, k, fallback)                                                                                  \
    {                                                                                                                  \
        name, 'I', 10, offsetof(UnusedCard, i[k]), fallback, true, FIELD_LISTED, SCALE_NONE                            \
    }
#define UNUSED_REAL(name, k, fallback)                                                                                 \
    {                                                                                                                  \
        name, 'F', 10, offsetof(UnusedCard, f[k]), fallback, true, FIELD_LISTED, SCALE_NONE                            \
    }

#endif

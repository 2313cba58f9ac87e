/* All keyword families, and the search of a keyword by name and options in any order. */
#include "io/keyword_table.h"

#include <string.h>

static const KeywordFamily *const families[] = {
    &keyword_family_deck,
    &keyword_family_nodes,
    &keyword_family_parts,
    &keyword_family_materials,
    &keyword_family_fabric,
    &keyword_family_orthotropic,
    &keyword_family_rubber,
    &keyword_family_porosity,
    &keyword_family_airbag,
    &keyword_family_airbag_hybrid,
    &keyword_family_airbag_laws,
    &keyword_family_airbag_connection,
    &keyword_family_reference_geometry,
    &keyword_family_sets,
    &keyword_family_curves,
    &keyword_family_functions,
    &keyword_family_coordinates,
    &keyword_family_boundary,
    &keyword_family_initial,
    &keyword_family_load,
    &keyword_family_damping,
    &keyword_family_rigidwall,
    &keyword_family_solids,
    &keyword_family_links,
    &keyword_family_springs,
    &keyword_family_masses,
    &keyword_family_seatbelt,
    &keyword_family_seams,
    &keyword_family_erosion,
    &keyword_family_rigid_bodies,
    &keyword_family_contact,
    &keyword_family_contact_entity,
    &keyword_family_control,
    &keyword_family_database,
    &keyword_family_ignored,
    &keyword_family_refused,
};

int keyword_family_count(void)
{
    return (int)(sizeof families / sizeof *families);
}

const KeywordFamily *keyword_family(int index)
{
    return families[index];
}

/* Length of name if it is the whole of text or is followed by an underscore there, else 0. */
static size_t match_word(const char *text, const char *name)
{
    const size_t length = strlen(name);
    if (strncmp(text, name, length) != 0) return 0;
    return text[length] == '\0' || text[length] == '_' ? length : 0;
}

/* Length of the longest of the entry's names that begins the keyword, 0 if none does. */
static size_t match_name(const KeywordSpec *spec, const char *keyword)
{
    size_t longest = match_word(keyword, spec->name);
    for (int i = 0; i < KEYWORD_MAX_ALIASES && spec->aliases[i]; i++) {
        const size_t length = match_word(keyword, spec->aliases[i]);
        if (length > longest) longest = length;
    }
    return longest;
}

/* Takes the words of rest ("_TITLE_ID") as options, the longest option first where one begins another. Returns the end
 * of what was understood. */
static const char *match_options(const KeywordSpec *spec, const char *rest, unsigned *options)
{
    *options = 0;
    while (*rest == '_') {
        size_t longest = 0;
        int found = -1;
        for (int i = 0; i < KEYWORD_MAX_OPTIONS && spec->options[i]; i++) {
            const size_t length = match_word(rest + 1, spec->options[i]);
            if (length <= longest) continue;
            longest = length;
            found = i;
        }
        if (found < 0) break;
        *options |= 1u << found;
        rest += 1 + longest;
    }
    return rest;
}

const KeywordSpec *keyword_find(const char *keyword, unsigned *options, const KeywordSpec **base, const char **rest)
{
    const KeywordSpec *best = NULL;
    size_t best_length = 0, base_length = 0;
    *options = 0;
    *base = NULL;
    *rest = NULL;
    for (int f = 0; f < keyword_family_count(); f++) {
        for (int i = 0; i < families[f]->count; i++) {
            const KeywordSpec *spec = &families[f]->specs[i];
            const size_t length = match_name(spec, keyword);
            if (length == 0) continue;
            unsigned found;
            const char *end = match_options(spec, keyword + length, &found);
            if ((*end == '\0' || spec->prefix) && length > best_length) {
                best = spec;
                best_length = length;
                *options = found;
            }
            if (*end != '\0' && length > base_length) {
                *base = spec;
                *rest = end + 1;
                base_length = length;
            }
        }
    }
    /* A family that is ignored as a whole must not swallow a misspelt option of a keyword that is read. */
    if (best && best->prefix && base_length > best_length && (*base)->state == KEYWORD_READ) return NULL;
    return best;
}

/* Number of letters to change, insert, remove or swap with the next to turn a into b, at most limit + 1. */
static int spelling_distance(const char *a, const char *b, int limit)
{
    enum { LONGEST = 48 };
    const int n = (int)strlen(a), m = (int)strlen(b);
    if (n > LONGEST || m > LONGEST || n - m > limit || m - n > limit) return limit + 1;
    int row[3][LONGEST + 1];
    for (int j = 0; j <= m; j++) row[0][j] = j;
    for (int i = 1; i <= n; i++) {
        int *now = row[i % 3];
        const int *above = row[(i + 2) % 3], *before = row[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= m; j++) {
            int least = above[j - 1] + (a[i - 1] != b[j - 1]);
            if (above[j] + 1 < least) least = above[j] + 1;
            if (now[j - 1] + 1 < least) least = now[j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && before[j - 2] + 1 < least)
                least = before[j - 2] + 1;
            now[j] = least;
        }
    }
    return row[n % 3][m];
}

const char *keyword_nearest(const char *keyword)
{
    const char *nearest = NULL;
    int least = 3;
    for (int f = 0; f < keyword_family_count(); f++) {
        for (int i = 0; i < families[f]->count; i++) {
            const int distance = spelling_distance(keyword, families[f]->specs[i].name, 2);
            if (distance >= least) continue;
            least = distance;
            nearest = families[f]->specs[i].name;
        }
    }
    return nearest;
}

/* The text of one file cut into lines and keyword blocks. */
#include <limits.h>
#include <string.h>

#include "io/deck_loader.h"
#include "solver/memory.h"

enum { TAB_STOP = 8 };

/* A file on its way through the splitter. */
typedef struct Splitter {
    DeckLoader *loader;
    char *at, *end;
    char *feed;      /* first LF not before at, end if there is none; NULL: not searched yet */
    int line;        /* number of the line last taken */
    DeckLine *lines; /* of the whole file, without comments and keywords */
    size_t line_count;
    DeckBlock block; /* the one being filled */
    bool in_block;
    bool any_keyword;
    bool stray_reported;
} Splitter;

static Source here(const Splitter *s)
{
    return (Source){s->loader->file, s->line};
}

static void report(const Splitter *s, const char *keyword, const char *what)
{
    diagnostics_add(s->loader->diagnostics, SEVERITY_ERROR, here(s), keyword, "%s", what);
}

/* The next line, zero-terminated in place of its LF, CR LF or CR; NULL at the end of the file. */
static char *take_line(Splitter *s, size_t *length)
{
    if (s->at >= s->end) return NULL;
    char *line = s->at;
    if (!s->feed || s->feed < line) {
        s->feed = memchr(line, '\n', (size_t)(s->end - line));
        if (!s->feed) s->feed = s->end;
    }
    char *carriage = memchr(line, '\r', (size_t)(s->feed - line));
    char *stop = carriage ? carriage : s->feed;
    s->at = stop + 1;
    if (carriage && carriage + 1 == s->feed) s->at = s->feed + 1;
    if (s->at > s->end) s->at = s->end;
    *stop = '\0'; /* the buffer has a byte to spare behind its end */
    *length = (size_t)(stop - line);
    s->line++;
    return line;
}

/* What a line holds besides plain text. */
typedef struct LineContent {
    bool tabs, binary;
} LineContent;

/* Page breaks and the end mark of DOS do no harm: they become blanks. */
static LineContent examine_line(char *line, size_t length)
{
    LineContent content = {false, false};
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)line[i];
        if (c >= 0x20 && c != 0x7f) continue;
        if (c == '\t') {
            content.tabs = true;
        } else if (c == '\f' || c == '\v' || c == 0x1a) {
            line[i] = ' ';
        } else {
            content.binary = true;
        }
    }
    return content;
}

static size_t expanded_length(const char *line)
{
    size_t column = 0;
    for (; *line; line++) column += *line == '\t' ? TAB_STOP - column % TAB_STOP : 1;
    return column;
}

/* The line with blanks for its tabs. */
static const char *expand_tabs(Splitter *s, const char *line, size_t length)
{
    char *text = loader_keep_text(s->loader, length + 1);
    if (!text) return NULL;
    size_t column = 0;
    for (; *line; line++) {
        size_t next = column + (*line == '\t' ? TAB_STOP - column % TAB_STOP : 1);
        memset(text + column, ' ', next - column);
        if (*line != '\t') text[column] = *line;
        column = next;
    }
    text[column] = '\0';
    return text;
}

static void finish_block(Splitter *s)
{
    if (!s->in_block) return;
    s->in_block = false;
    s->block.line_count = (size_t)(s->lines + s->line_count - s->block.lines);
    loader_take_block(s->loader, &s->block);
}

static char upper_case(char c)
{
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

static bool ends_keyword(char c)
{
    return c == '\0' || c == ' ' || c == '\t' || c == ',';
}

/* True if text starts with option (upper case) in any case. */
static bool starts_with(const char *text, const char *option)
{
    for (; *option; text++, option++) {
        if (upper_case(*text) != *option) return false;
    }
    return true;
}

/* LONG=, I10= behind *KEYWORD; memory sizes and NCPU= mean nothing here. */
static void read_keyword_options(Splitter *s, const char *rest)
{
    DeckLoader *loader = s->loader;
    while (*rest) {
        while (*rest && ends_keyword(*rest)) rest++;
        if (starts_with(rest, "LONG=")) {
            char value = upper_case(rest[5]);
            if (value == '\0' || !strchr("YKSN", value) || !ends_keyword(rest[6])) {
                report(s, "*KEYWORD", "LONG= must be Y or K (long format) or S (standard format)");
            }
            loader->wide = value == 'Y' || value == 'K';
        }
        if (starts_with(rest, "I10=")) loader->i10 = upper_case(rest[4]) == 'Y';
        while (!ends_keyword(*rest)) rest++;
    }
}

/* +, - or % behind the keyword chooses the format of this block alone. */
static void apply_format_mark(DeckBlock *block, char mark)
{
    if (mark == '+') block->wide = true;
    if (mark == '-') block->wide = block->i10 = false;
    if (mark == '%') {
        block->wide = false;
        block->i10 = true;
    }
}

static bool is_format_mark(char c)
{
    return c == '+' || c == '-' || c == '%';
}

/* Starts a block from its keyword line; false for *END. */
static bool start_block(Splitter *s, const char *line)
{
    DeckLoader *loader = s->loader;
    size_t length = 0;
    s->block = (DeckBlock){.wide = loader->wide,
                           .i10 = loader->i10,
                           .source = here(s),
                           .lines = s->lines + s->line_count,
                           .transform = loader->transform,
                           .order = loader->order++,
                           .scope = loader->scope};
    while (!ends_keyword(line[length])) length++;
    const char *rest = line + length;
    while (*rest == ' ' || *rest == '\t') rest++;
    if (length > 1 && is_format_mark(line[length - 1])) {
        apply_format_mark(&s->block, line[--length]);
    } else if (is_format_mark(*rest) && ends_keyword(rest[1])) {
        apply_format_mark(&s->block, *rest);
    }
    s->any_keyword = true;
    if (length == 1) {
        report(s, "*", "the keyword's name is missing; it must follow the star at once");
        return true;
    }
    if (length >= sizeof s->block.keyword) {
        report(s, NULL, "this keyword is longer than any that exists");
        return true;
    }
    for (size_t i = 0; i < length; i++) s->block.keyword[i] = upper_case(line[i]);
    if (strcmp(s->block.keyword, "*END") == 0) return false;
    if (strcmp(s->block.keyword, "*KEYWORD") == 0) read_keyword_options(s, rest);
    s->in_block = true;
    return true;
}

/* Adds a data line to the block; false if the file is to be given up. */
static bool add_data_line(Splitter *s, char *line, size_t length)
{
    LineContent content = examine_line(line, length);
    if (content.binary) {
        report(s, NULL, "this is no text: the line holds control characters; is the file a deck?");
        return false;
    }
    if (content.tabs) length = expanded_length(line);
    if (length > BILLOW_LONGEST_LINE) {
        diagnostics_add(s->loader->diagnostics, SEVERITY_ERROR, here(s), s->in_block ? s->block.keyword : NULL,
                        "the line has %zu characters, more than the %d that a card may have", length,
                        (int)BILLOW_LONGEST_LINE);
        return true;
    }
    if (!s->in_block) {
        bool blank = strspn(line, " \t") == strlen(line);
        if (!s->any_keyword && !s->stray_reported && !blank) {
            report(s, NULL, "data before the first keyword; a deck begins with *KEYWORD, its star in column 1");
            s->stray_reported = true;
        }
        return true;
    }
    const char *text = content.tabs ? expand_tabs(s, line, length) : line;
    if (!text) return false;
    s->lines[s->line_count++] = (DeckLine){text, here(s)};
    return true;
}

/* Line by line to *END or the end of the file; false if the file is to be given up. */
static bool split_lines(Splitter *s)
{
    size_t length = 0;
    for (char *line = take_line(s, &length); line; line = take_line(s, &length)) {
        if (s->line == INT_MAX) {
            report(s, NULL, "the file has too many lines");
            return false;
        }
        if (line[0] == '$') continue;
        if (line[0] != '*') {
            if (!add_data_line(s, line, length)) return false;
            continue;
        }
        finish_block(s);
        if (examine_line(line, length).binary) {
            report(s, NULL, "this is no text: the line holds control characters; is the file a deck?");
            return false;
        }
        if (!start_block(s, line)) return true;
    }
    finish_block(s);
    return true;
}

static size_t count_lines(const char *text, size_t length)
{
    size_t count = 1;
    for (size_t i = 0; i < length; i++) count += text[i] == '\n' || text[i] == '\r';
    return count;
}

/* Reports what makes the whole file unreadable; true if something does. */
static bool refuse_file(Splitter *s, const char *text, size_t length)
{
    static const char *const hint = "the file is %s; save it as plain text";
    const unsigned char *bytes = (const unsigned char *)text;
    const char *zero = memchr(text, '\0', length);
    s->line = 1;
    if (length == 0) {
        report(s, NULL, "the file is empty; a deck begins with *KEYWORD");
    } else if (length >= 2 && ((bytes[0] == 0xff && bytes[1] == 0xfe) || (bytes[0] == 0xfe && bytes[1] == 0xff))) {
        diagnostics_add(s->loader->diagnostics, SEVERITY_ERROR, here(s), NULL, hint, "in UTF-16");
    } else if (zero) {
        s->line = (int)(count_lines(text, (size_t)(zero - text)) % INT_MAX);
        diagnostics_add(s->loader->diagnostics, SEVERITY_ERROR, here(s), NULL, hint,
                        "binary: the line holds a zero byte");
    } else {
        s->line = 0;
        return false;
    }
    return true;
}

void loader_split_text(DeckLoader *loader, char *text, size_t length)
{
    Splitter s = {.loader = loader, .at = text, .end = text + length};
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) s.at += 3; /* byte order mark */
    if (refuse_file(&s, text, length)) return;
    while (s.end > s.at && s.end[-1] == 0x1a) s.end--; /* the end mark of DOS */
    s.lines = loader_keep(loader, count_lines(text, length), sizeof *s.lines);
    if (!s.lines) return;
    size_t blocks_before = loader->deck->blocks.count;
    if (!split_lines(&s)) {
        loader->deck->blocks.count = blocks_before; /* a file that is no text means nothing, not even in part */
        return;
    }
    if (!s.any_keyword && !s.stray_reported && loader->depth == 1) {
        s.line = 1;
        report(&s, NULL, "no keyword in the file; a deck begins with *KEYWORD");
    }
}

/* *KEYWORD's own lines (project, job) and comments have no effect; only what looks like lost data is mentioned. */
static bool drop_block(DeckLoader *loader, const DeckBlock *block)
{
    if (strcmp(block->keyword, "*COMMENT") == 0) return true;
    bool is_keyword = strcmp(block->keyword, "*KEYWORD") == 0;
    if (is_keyword && block->line_count > 0) {
        diagnostics_add(loader->diagnostics, SEVERITY_NOTE, block->lines[0].source, block->keyword,
                        "the lines that follow *KEYWORD are not used");
    }
    return is_keyword || strcmp(block->keyword, "*KEYWORD_ID") == 0 || strcmp(block->keyword, "*KEYWORD_JOBID") == 0;
}

void loader_take_block(DeckLoader *loader, const DeckBlock *block)
{
    DeckText *deck = loader->deck;
    if (drop_block(loader, block) || loader_include(loader, block) || loader_define_transformation(loader, block))
        return;
    if (parameters_read_block(deck->parameters, block, loader->diagnostics)) return;
    if (memory_reserve((void **)&deck->blocks.items, &deck->blocks.capacity, deck->blocks.count + 1,
                       sizeof *deck->blocks.items)) {
        loader_report_memory(loader);
        return;
    }
    deck->blocks.items[deck->blocks.count++] = *block;
}

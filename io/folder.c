/* The folder of results: made, taken over from an earlier run, or refused. */
#include "io/folder.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/checkpoint.h"
#include "io/log.h"
#include "io/summary.h"

static bool folder_is_empty(const char *directory)
{
    DIR *stream = opendir(directory);
    if (!stream) return false;
    bool empty = true;
    for (const struct dirent *entry; empty && (entry = readdir(stream));)
        empty = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
    closedir(stream);
    return empty;
}

FolderState folder_inspect(const char *directory)
{
    struct stat status;
    if (lstat(directory, &status)) return errno == ENOENT ? FOLDER_MISSING : FOLDER_FOREIGN;
    if (stat(directory, &status) || !S_ISDIR(status.st_mode)) return FOLDER_FOREIGN;
    if (log_marks_folder(directory)) return FOLDER_OURS;
    return folder_is_empty(directory) ? FOLDER_EMPTY : FOLDER_FOREIGN;
}

bool folder_contains(const char *directory, const char *file)
{
    char parent[PATH_MAX];
    const char *slash = strrchr(file, '/');
    const int length = slash ? (int)(slash - file) + 1 : 0;
    if (snprintf(parent, sizeof parent, "%.*s.", length, file) >= (int)sizeof parent) return false;
    struct stat a, b;
    return stat(directory, &a) == 0 && stat(parent, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

int folder_claim(const char *directory, bool keep, Diagnostics *diagnostics)
{
    static const char *const names[] = {BILLOW_CHECKPOINT_NAME, BILLOW_SUMMARY_NAME};
    const FolderState state = folder_inspect(directory);
    if (state == FOLDER_FOREIGN) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "%s exists and does not hold results of billow: nothing is overwritten; choose another folder "
                        "with -o, or remove it",
                        directory);
        return -1;
    }
    if (state == FOLDER_MISSING && mkdir(directory, 0777)) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot make the folder %s: %s",
                        directory, strerror(errno));
        return -1;
    }
    if (state != FOLDER_OURS || keep) return 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[PATH_MAX];
        if (snprintf(path, sizeof path, "%s/%s", directory, names[i]) >= (int)sizeof path) continue;
        if (unlink(path) && errno != ENOENT) {
            diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot replace %s: %s", path,
                            strerror(errno));
            return -1;
        }
    }
    return 0;
}

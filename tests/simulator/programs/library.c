/* Tries the C library's calls for help from the SPU's side. Needs a folder that it may write to. The exit
   code is 0, or 1 behind the first check that fails, which is printed. */
#include <sys/types.h> /* newlib's <dirent.h> needs it */

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#define CHECK(condition)                                                                                     \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      printf("line %d: %s, errno %d\n", __LINE__, #condition, errno);                                        \
      exit(1);                                                                                               \
    }                                                                                                        \
  } while (0)

static void print_into(char* to, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsprintf(to, format, arguments);
  va_end(arguments);
}

static void check_formats(void) {
  char text[200];
  CHECK(sprintf(text, "%d %5.2f %s %c %llx %lu %%", -7, 2.375, "word", 'c', 0x123456789abcdefLL, 42ul) == 36);
  CHECK(strcmp(text, "-7  2.38 word c 123456789abcdef 42 %") == 0);
  print_into(text, "%d %g %lld", 1, 0.5, 1ll << 40);
  CHECK(strcmp(text, "1 0.5 1099511627776") == 0);
  volatile size_t room = 4;
  CHECK(snprintf(text, room, "%s", "truncated") == 9);
  CHECK(strcmp(text, "tru") == 0);
  int number = 0;
  double fraction = 0;
  float single = 0;
  char word[20];
  long long wide = 0;
  CHECK(sscanf("12 3.5 0.25 word -99999999999", "%d %lf %f %s %lld", &number, &fraction, &single, word,
               &wide) == 5);
  CHECK(number == 12 && fraction == 3.5 && single == 0.25f && strcmp(word, "word") == 0 &&
        wide == -99999999999ll);
}

/* More arguments than registers for them. */
static void check_many_arguments(void) {
  char text[1000];
#define TEN "%d%d%d%d%d%d%d%d%d%d"
#define DIGITS 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
  sprintf(text, TEN TEN TEN TEN TEN TEN TEN TEN, DIGITS, DIGITS, DIGITS, DIGITS, DIGITS, DIGITS, DIGITS,
          DIGITS);
  CHECK(strlen(text) == 80);
  for (int i = 0; i < 80; ++i)
    CHECK(text[i] == '0' + i % 10);
}

static void check_streams(void) {
  FILE* file = fopen("stream", "w+");
  CHECK(file != NULL);
  CHECK(fputs("first line\nsecond", file) >= 0);
  CHECK(fprintf(file, " %d\n", 17) == 4);
  CHECK(ftell(file) == 21);
  rewind(file);
  char line[40];
  CHECK(fgets(line, sizeof line, file) == line);
  CHECK(strcmp(line, "first line\n") == 0);
  fpos_t position;
  CHECK(fgetpos(file, &position) == 0);
  CHECK(fgetc(file) == 's');
  CHECK(ungetc('S', file) == 'S');
  int number = 0;
  CHECK(fscanf(file, "%s %d", line, &number) == 2);
  CHECK(strcmp(line, "Second") == 0 && number == 17);
  CHECK(fsetpos(file, &position) == 0);
  CHECK(fread(line, 2, 3, file) == 3);
  CHECK(memcmp(line, "second", 6) == 0);
  CHECK(fseek(file, 0, SEEK_END) == 0);
  CHECK(getc(file) == EOF && feof(file) && !ferror(file));
  clearerr(file);
  CHECK(!feof(file));
  CHECK(fflush(file) == 0 && fclose(file) == 0);
  errno = 0;
  CHECK(fopen("none", "r") == NULL && errno == ENOENT);
  CHECK(fopen("/etc/passwd", "r") == NULL && errno == EACCES);
  CHECK(rename("stream", "renamed") == 0 && remove("renamed") == 0);
  FILE* temporary = tmpfile();
  CHECK(temporary != NULL && fwrite("abc", 1, 3, temporary) == 3 && fclose(temporary) == 0);
}

static void check_files(void) {
  const int file = open("file", O_RDWR | O_CREAT | O_TRUNC, 0640);
  CHECK(file > 2);
  CHECK(open("file", O_RDWR | O_CREAT | O_EXCL, 0640) == -1 && errno == EEXIST);
  CHECK(write(file, "0123456789", 10) == 10);
  CHECK(lseek(file, 3, SEEK_SET) == 3);
  char text[20];
  CHECK(read(file, text, 4) == 4 && memcmp(text, "3456", 4) == 0);
  CHECK(pread(file, text, 2, 8) == 2 && text[0] == '8');
  const struct iovec parts[] = {{text, 2}, {"xyz", 3}};
  CHECK(lseek(file, 0, SEEK_END) == 10);
  CHECK(writev(file, parts, 2) == 5);
  struct stat status;
  CHECK(fstat(file, &status) == 0);
  CHECK(status.st_size == 15 && S_ISREG(status.st_mode) && (status.st_mode & 0777) == 0640 &&
        status.st_nlink == 1);
  CHECK(status.st_mtime > 1000000000);
  CHECK(ftruncate(file, 5) == 0 && stat("file", &status) == 0 && status.st_size == 5);
  const int copy = dup(file);
  CHECK(copy > file && close(copy) == 0 && close(copy) == -1 && errno == EBADF);
  CHECK(close(file) == 0);
  CHECK(access("file", R_OK) == 0 && unlink("file") == 0 && access("file", F_OK) == -1);
  CHECK(fstat(1, &status) == 0 && S_ISCHR(status.st_mode));
}

static void check_folders(void) {
  CHECK(mkdir("folder", 0755) == 0 && chdir("folder") == 0);
  char path[1024];
  CHECK(getcwd(path, sizeof path) == path && strlen(path) > 7 &&
        strcmp(path + strlen(path) - 7, "/folder") == 0);
  CHECK(close(open("entry", O_WRONLY | O_CREAT, 0600)) == 0);
  DIR* folder = opendir(".");
  CHECK(folder != NULL);
  int found = 0, count = 0;
  for (struct dirent* entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
    found += strcmp(entry->d_name, "entry") == 0;
    ++count;
  }
  CHECK(found == 1 && count == 3);
  CHECK(closedir(folder) == 0 && unlink("entry") == 0 && chdir("..") == 0 && rmdir("folder") == 0);
}

static void check_time(void) {
  struct timeval now;
  CHECK(gettimeofday(&now, NULL) == 0);
  CHECK(now.tv_sec > 1000000000 && now.tv_sec < 10000000000ll && now.tv_usec >= 0 && now.tv_usec < 1000000);
  const time_t seconds = time(NULL);
  CHECK(seconds >= now.tv_sec && seconds <= now.tv_sec + 10);
  const struct timespec moment = {0, 1000};
  CHECK(nanosleep(&moment, NULL) == 0);
}

int main(void) {
  check_formats();
  check_many_arguments();
  check_streams();
  check_files();
  check_folders();
  check_time();
  puts("all checks passed");
  return 0;
}

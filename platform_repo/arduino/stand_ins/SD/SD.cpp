// Stand-in with the API of the Arduino library SD 1.3, on RAM. Own code.
#include "SD.h"

#include <string.h>

static const uint8_t ROOM = 96, FILES = 2, ROOT = 255;

struct Kept {
  char name[13];   // empty for a free place
  uint8_t length;  // with what is not on the card yet
  uint8_t stored;  // what is on the card, and what is read without writing
  bool folder;     // an empty one
  uint8_t bytes[ROOM];
};

static Kept kept[FILES];
static bool begun = false;

static uint8_t length_of(const Kept &file, uint8_t mode) {
  return mode & O_WRITE ? file.length : file.stored;
}

static uint8_t number_of(const char *name) {
  for (uint8_t number = 0; number < FILES; number++)
    if (!strcasecmp(kept[number].name, name)) return number + 1;
  return 0;
}

File::File() : number(0), mode(0), at(0) {}

File::File(uint8_t number, uint8_t mode)
    : number(number), mode(mode), at(number != ROOT && mode & (O_APPEND | O_WRITE) ? kept[number - 1].length : 0) {}

size_t File::write(uint8_t byte) {
  if (isDirectory() || !number || !(mode & O_WRITE)) return 0;
  Kept &file = kept[number - 1];
  if (mode & O_APPEND) at = file.length;
  if (at >= ROOM) return 0;
  file.bytes[at++] = byte;
  if (at > file.length) file.length = at;
  return 1;
}

size_t File::write(const uint8_t *bytes, size_t count) {
  size_t written = 0;
  while (written < count && write(bytes[written])) written++;
  return written;
}

int File::availableForWrite() {
  return number && !isDirectory() ? ROOM - at : 0;
}

int File::read() {
  int byte = peek();
  if (byte >= 0) at++;
  return byte;
}

int File::read(void *bytes, uint16_t count) {
  uint16_t taken = 0;
  for (; taken < count && available(); taken++) static_cast<uint8_t *>(bytes)[taken] = read();
  return taken;
}

int File::peek() {
  return available() ? kept[number - 1].bytes[at] : -1;
}

int File::available() {
  return number && !isDirectory() && mode & O_READ ? length_of(kept[number - 1], mode) - at : 0;
}

void File::flush() {
  if (number && !isDirectory() && mode & O_WRITE) kept[number - 1].stored = kept[number - 1].length;
}

bool File::seek(uint32_t to) {
  if (!number || to > size()) return false;
  at = to;
  return true;
}

uint32_t File::position() {
  return number ? at : -1;
}

uint32_t File::size() {
  return number && !isDirectory() ? length_of(kept[number - 1], mode) : 0;
}

void File::close() {
  flush();
  number = 0;
}

File::operator bool() {
  return number;
}

char *File::name() {
  static char none[] = "", root[] = "/";
  return number == ROOT ? root : number ? kept[number - 1].name : none;
}

bool File::isDirectory() {
  return number == ROOT || (number && kept[number - 1].folder);
}

File File::openNextFile(uint8_t mode) {
  while (number == ROOT && at < FILES)
    if (*kept[at++].name) return File(at, mode);
  return File();
}

void File::rewindDirectory() {
  at = 0;
}

bool SDClass::begin(uint8_t) {
  return begun = true;
}

bool SDClass::begin(uint32_t, uint8_t) {
  return begun = true;
}

void SDClass::end() {
  begun = false;
}

File SDClass::open(const char *name, uint8_t mode) {
  if (!begun || !*name) return File();
  if (!strcmp(name, "/")) return File(ROOT, mode);
  if (*name == '/') name++;
  if (strlen(name) > 12) return File();
  uint8_t number = number_of(name);
  if (!number && mode & O_CREAT && (number = number_of(""))) strcpy(kept[number - 1].name, name);
  if (!number) return File();
  if (mode & O_TRUNC) kept[number - 1].length = kept[number - 1].stored = 0;
  return File(number, mode);
}

bool SDClass::exists(const char *name) {
  return begun && *name && number_of(name);
}

static bool take_away(const char *name, bool folder) {
  uint8_t number = begun && *name ? number_of(name) : 0;
  if (!number || kept[number - 1].folder != folder) return false;
  kept[number - 1] = Kept();
  return true;
}

bool SDClass::remove(const char *name) {
  return take_away(name, false);
}

bool SDClass::rmdir(const char *name) {
  return take_away(name, true);
}

bool SDClass::mkdir(const char *name) {
  uint8_t number = number_of(name);
  if (number) return kept[number - 1].folder;
  File made = open(name, O_WRITE | O_CREAT);
  if (made) kept[number_of(name) - 1].folder = true;
  return made;
}

SDClass SD;

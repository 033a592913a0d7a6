// Stand-in with the API of the Arduino library SD 1.3, on RAM. Own code.
#ifndef SD_h
#define SD_h

#include <Arduino.h>

#define O_READ 0x01
#define O_WRITE 0x02
#define O_APPEND 0x04
#define O_CREAT 0x10
#define O_TRUNC 0x40
#define FILE_READ O_READ
#define FILE_WRITE (O_READ | O_WRITE | O_CREAT | O_APPEND)

class File : public Stream {
 public:
  File();
  File(uint8_t number, uint8_t mode);
  size_t write(uint8_t byte);
  size_t write(const uint8_t *bytes, size_t count);
  int availableForWrite();
  int read();
  int read(void *bytes, uint16_t count);
  int peek();
  int available();
  void flush();
  bool seek(uint32_t to);
  uint32_t position();
  uint32_t size();
  void close();
  operator bool();
  char *name();
  bool isDirectory();
  File openNextFile(uint8_t mode = FILE_READ);
  void rewindDirectory();
  using Print::write;

 private:
  uint8_t number;  // 0 for none, 255 for the card's folder
  uint8_t mode;
  uint8_t at;
};

class SDClass {
 public:
  bool begin(uint8_t select = SS);
  bool begin(uint32_t clock, uint8_t select);
  void end();
  File open(const char *name, uint8_t mode = FILE_READ);
  bool exists(const char *name);
  bool remove(const char *name);
  bool mkdir(const char *name);
  bool rmdir(const char *name);
};

extern SDClass SD;

#endif

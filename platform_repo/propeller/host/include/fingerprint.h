/* fingerprint.h of the Simple Libraries: a reader of fingerprints on a serial line. */
#ifndef ROBOSMI_FINGERPRINT_H
#define ROBOSMI_FINGERPRINT_H
#include "simpletools.h"
#include "fdserial.h"
#define ACK_SUCCESS 0x00
#define ACK_FAIL 0x01
#define ACK_FULL 0x04
#define ACK_NOUSER 0x05
#define ACK_USER_EXISTS 0x07
#define ACK_TIMEOUT 0x08
#define CMD_SLEEP 0x2C
#define CMD_SET_MODE 0x2D
#define CMD_ADD_FINGERPRINT_1 0x01
#define CMD_ADD_FINGERPRINT_2 0x02
#define CMD_ADD_FINGERPRINT_3 0x03
#define CMD_DELETE_USER 0x04
#define CMD_DELETE_ALL_USERS 0x05
#define CMD_GET_USERS_COUNT 0x09
#define CMD_SCAN_COMPARE_1_TO_1 0x0B
#define CMD_SCAN_COMPARE_1_TO_N 0x0C
#define CMD_READ_USER_PRIVLAGE 0x0A
#define CMD_SENSITIVITY 0x28
#define CMD_SCAN_GET_IMAGE 0x24
#define CMD_SCAN_GET_EIGENVALS 0x23
#define CMD_SCAN_PUT_EIGENVALS 0x44
#define CMD_PUT_EIGENVALS_COMPARE_1_TO_1 0x42
#define CMD_PUT_EIGENVALS_COMPARE_1_TO_N 0x43
#define CMD_GET_USER_EIGENVALS 0x31
#define CMD_PUT_USER_EIGENVALS 0x41
#define CMD_GET_USERS_INFO 0x2B
#define CMD_SET_SCAN_TIMEOUT 0x2E
typedef fdserial_st fpScanner_t;
typedef text_t fpScanner;
fpScanner *fingerprint_open(int pin_rx, int pin_tx);
void fingerprint_close(fpScanner *device);
void fingerprint_sendCommand(fpScanner *device, char __fpCmd, char __fpParam1, char __fpParam2, char __fpParam3);
void fingerprint_readResponse(fpScanner *device, char *__fpResponse);
int fingerprint_allowOverwrite(fpScanner *device, char b);
int fingerprint_add(fpScanner *device, int userId, char userLevel, int scanNumber);
int fingerprint_deleteUser(fpScanner *device, int userId);
int fingerprint_countUsers(fpScanner *device);
int fingerprint_scan(fpScanner *device, int userId, int *uid);
int fingerprint_lookupUserPrivlage(fpScanner *device, int userId);
int fingerprint_setTimeout(fpScanner *device, int timeout);
int fingerprint_setStrictness(fpScanner *device, char s_level);
#endif

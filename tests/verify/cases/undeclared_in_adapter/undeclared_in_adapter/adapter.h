#pragma once

void turn(int pin);

#pragma once
#define SHOWN index

/* aisle_cyclone_subscriber --domain N [--partition NAME] [--interface ADDRESS] [--seconds N]
 *
 * Joins a site with Cyclone DDS, with types made from our IDL, and waits for one sample each of map_info, map_tile,
 * vehicle_info, vehicle_state, plan and coverage. Prints a line of JSON for each; exit code 0 when all were seen, 1
 * when not within the time (default 20 s). */
#include <dds/dds.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "map.h"
#include "planning.h"
#include "tracking.h"
#include "vehicle.h"

struct options {
  unsigned domain;
  const char* partition;
  const char* interface_address;
  int seconds;
};

/* Cyclone takes the interface in its configuration only; multicast is said to work so that it is used on loopback too.
 */
static dds_entity_t join(const struct options* options) {
  char config[512];
  if (options->interface_address != NULL) {
    snprintf(config, sizeof config,
             "<General><Interfaces><NetworkInterface address=\"%s\" multicast=\"true\"/></Interfaces></General>"
             "<Discovery><MaxAutoParticipantIndex>250</MaxAutoParticipantIndex></Discovery>",
             options->interface_address);
    const dds_entity_t domain = dds_create_domain(options->domain, config);
    if (domain < 0) return domain;
  }
  return dds_create_participant(options->domain, NULL, NULL);
}

static dds_entity_t read_topic(dds_entity_t participant, const struct options* options,
                               const dds_topic_descriptor_t* type, const char* name, bool reliable, bool exclusive) {
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  if (topic < 0) return topic;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(100));
  dds_qset_durability(qos, reliable ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_ownership(qos, exclusive ? DDS_OWNERSHIP_EXCLUSIVE : DDS_OWNERSHIP_SHARED);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  if (options->partition[0] != '\0') {
    const char* names[] = {options->partition};
    dds_qset_partition(qos, 1, names);
  }
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

/* A JSON string: ids are plain text, but who knows. */
static void print_text(const char* key, const char* text) {
  printf("\"%s\": \"", key);
  for (; *text != '\0'; ++text) {
    if ((unsigned char)*text < 0x20)
      printf("\\u%04x", (unsigned char)*text);
    else if (*text == '"' || *text == '\\')
      printf("\\%c", *text);
    else
      putchar(*text);
  }
  putchar('"');
}

static void print_map_info(const void* sample) {
  const aisle_MapInfo* info = sample;
  print_text("map_id", info->map_id);
  printf(
      ", \"revision\": %llu, \"width_cells\": %u, \"height_cells\": %u, \"resolution_m\": %.9g, \"tile_hashes\": %u, "
      "\"first_hash\": %llu",
      (unsigned long long)info->revision, info->width_cells, info->height_cells, info->resolution_m,
      info->tile_hashes._length,
      (unsigned long long)(info->tile_hashes._length > 0 ? info->tile_hashes._buffer[0] : 0));
}

static void print_map_tile(const void* sample) {
  const aisle_MapTile* tile = sample;
  unsigned occupied = 0;
  for (uint32_t i = 0; i < tile->cells._length; ++i) occupied += tile->cells._buffer[i] == 1;
  print_text("map_id", tile->map_id);
  printf(", \"tile_x\": %u, \"tile_y\": %u, \"hash\": %llu, \"cells\": %u, \"occupied\": %u", tile->tile_x,
         tile->tile_y, (unsigned long long)tile->hash, tile->cells._length, occupied);
}

static void print_vehicle_state(const void* sample) {
  const aisle_VehicleState* state = sample;
  print_text("agv_id", state->agv_id);
  printf(
      ", \"x_m\": %.9g, \"y_m\": %.9g, \"yaw_rad\": %.9g, \"linear_mps\": %.9g, \"sideways_mps\": %.9g, "
      "\"steering_rad\": %.9g",
      state->base_in_map.x_m, state->base_in_map.y_m, state->base_in_map.yaw_rad, state->twist.linear_mps,
      state->twist.sideways_mps, state->steering_rad);
}

static void print_vehicle_info(const void* sample) {
  const aisle_VehicleInfo* info = sample;
  print_text("agv_id", info->agv_id);
  printf(
      ", \"model\": %d, \"footprint\": %d, \"length_m\": %.9g, \"ahead_m\": %.9g, \"steers_behind\": %d, "
      "\"wheelbase_m\": %.9g, \"max_steering_rate_radps\": %.9g",
      (int)info->model, (int)info->footprint, info->length_m, info->ahead_m, info->steers_behind ? 1 : 0,
      info->wheelbase_m, info->max_steering_rate_radps);
}

static void print_plan(const void* sample) {
  const aisle_Plan* plan = sample;
  print_text("agv_id", plan->agv_id);
  printf(", ");
  print_text("source_id", plan->by.source_id);
  printf(", \"plan_id\": %llu, \"outcome\": %d, \"map_revision\": %llu, \"waypoints\": %u, \"last_x_m\": %.9g",
         (unsigned long long)plan->plan_id, (int)plan->outcome, (unsigned long long)plan->map_revision,
         plan->waypoints_in_map._length,
         plan->waypoints_in_map._length > 0 ? plan->waypoints_in_map._buffer[plan->waypoints_in_map._length - 1].x_m
                                            : 0.0);
}

static void print_coverage(const void* sample) {
  const aisle_Coverage* coverage = sample;
  unsigned unseen = 0;
  for (uint32_t i = 0; i < coverage->ages._length; ++i) unseen += coverage->ages._buffer[i] == 255;
  print_text("source_id", coverage->source_id);
  printf(", \"tile_x\": %u, \"tile_y\": %u, \"cell_m\": %.9g, \"cells\": %u, \"unseen\": %u", coverage->tile_x,
         coverage->tile_y, coverage->cell_m, coverage->ages._length, unseen);
}

struct kind {
  const char* topic;
  const dds_topic_descriptor_t* type;
  bool reliable;
  bool exclusive;
  void (*print)(const void* sample);
  dds_entity_t reader;
  bool seen;
};

static void take(struct kind* kind) {
  void* samples[1] = {NULL};
  dds_sample_info_t info;
  while (!kind->seen && dds_take(kind->reader, samples, &info, 1, 1) > 0) {
    if (info.valid_data) {
      printf("{\"topic\": \"%s\", ", kind->topic);
      kind->print(samples[0]);
      printf("}\n");
      fflush(stdout);
      kind->seen = true;
    }
    dds_return_loan(kind->reader, samples, 1);
    samples[0] = NULL;
  }
}

static int wait_for_all(dds_entity_t participant, struct kind* kinds, size_t count, int seconds) {
  const dds_entity_t waitset = dds_create_waitset(participant);
  for (size_t i = 0; i < count; ++i) {
    dds_set_status_mask(kinds[i].reader, DDS_DATA_AVAILABLE_STATUS);
    dds_waitset_attach(waitset, kinds[i].reader, (dds_attach_t)i);
  }
  const dds_time_t end = dds_time() + DDS_SECS(seconds);
  for (;;) {
    size_t seen = 0;
    for (size_t i = 0; i < count; ++i) {
      take(&kinds[i]);
      seen += kinds[i].seen;
      if (kinds[i].seen) dds_waitset_detach(waitset, kinds[i].reader);
    }
    if (seen == count) return 0;
    if (dds_time() >= end) break;
    dds_waitset_wait_until(waitset, NULL, 0, end);
  }
  for (size_t i = 0; i < count; ++i) {
    if (!kinds[i].seen) fprintf(stderr, "no sample of %s within %d s\n", kinds[i].topic, seconds);
  }
  return 1;
}

static bool parse(int argc, char** argv, struct options* options) {
  for (int i = 1; i + 1 < argc; i += 2) {
    if (strcmp(argv[i], "--domain") == 0)
      options->domain = (unsigned)atoi(argv[i + 1]);
    else if (strcmp(argv[i], "--partition") == 0)
      options->partition = argv[i + 1];
    else if (strcmp(argv[i], "--interface") == 0)
      options->interface_address = argv[i + 1];
    else if (strcmp(argv[i], "--seconds") == 0)
      options->seconds = atoi(argv[i + 1]);
    else
      return false;
  }
  return argc % 2 == 1;
}

int main(int argc, char** argv) {
  struct options options = {0, "", NULL, 20};
  struct kind kinds[] = {
      {"map_info", &aisle_MapInfo_desc, true, false, print_map_info, 0, false},
      {"map_tile", &aisle_MapTile_desc, true, false, print_map_tile, 0, false},
      {"vehicle_info", &aisle_VehicleInfo_desc, true, false, print_vehicle_info, 0, false},
      {"vehicle_state", &aisle_VehicleState_desc, false, false, print_vehicle_state, 0, false},
      {"plan", &aisle_Plan_desc, true, true, print_plan, 0, false},
      {"coverage", &aisle_Coverage_desc, true, false, print_coverage, 0, false},
  };
  const size_t count = sizeof kinds / sizeof kinds[0];
  if (!parse(argc, argv, &options)) {
    fprintf(stderr, "usage: %s --domain N [--partition NAME] [--interface ADDRESS] [--seconds N]\n", argv[0]);
    return 2;
  }
  const dds_entity_t participant = join(&options);
  if (participant < 0) {
    fprintf(stderr, "cannot join domain %u: %s\n", options.domain, dds_strretcode(-participant));
    return 3;
  }
  for (size_t i = 0; i < count; ++i) {
    kinds[i].reader =
        read_topic(participant, &options, kinds[i].type, kinds[i].topic, kinds[i].reliable, kinds[i].exclusive);
    if (kinds[i].reader < 0) {
      fprintf(stderr, "cannot read %s: %s\n", kinds[i].topic, dds_strretcode(-kinds[i].reader));
      return 3;
    }
  }
  const int result = wait_for_all(participant, kinds, count, options.seconds);
  dds_delete(participant);
  return result;
}

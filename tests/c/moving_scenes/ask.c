#include "c/asking.h"

static espalier_transform some_transform(const struct question* question, int i) {
    espalier_transform transform;
    transform.rotation.x = question->rotation[0];
    transform.rotation.y = question->rotation[1];
    transform.rotation.z = question->rotation[2];
    transform.rotation.w = question->rotation[3];
    transform.translation = question->points[i];
    transform.scale = question->bits % 5u == 0 ? question->lengths[i] : 0.5f + (float)(question->bits % 8u) / 8.0f;
    return transform;
}

static void tell_handle(struct asking* asking, espalier_instance_handle_result handle) {
    tell(asking, handle.status);
    tell(asking, handle.value.slot);
    tell(asking, handle.value.generation);
}

/* The handle of a slot, or of one behind all that were used. */
static espalier_instance_handle some_handle(struct asking* asking, uint32_t bits) {
    const uint32_t slot = bits % (espalier_moving_scene_slot_end(asking->moving) + 1u);
    const espalier_instance_handle_result handle = espalier_moving_scene_handle_of(asking->moving, slot);
    tell_handle(asking, handle);
    return handle.value;
}

void ask_changes(struct asking* asking) {
    const struct question* question = asking->question;
    espalier_moving_scene* scene = asking->moving;
    const uint32_t bits = question->bits;
    for (int i = 0; i < 4; ++i) {
        const espalier_instance instance = {some_transform(question, i), (bits >> i) % 7u, bits >> 8, bits, 7};
        tell_handle(asking, espalier_moving_scene_insert(scene, &instance));
    }
    const espalier_instance_handle any = {bits % 50u, bits >> 30};
    const espalier_transform place = some_transform(question, 3);
    tell(asking, espalier_moving_scene_remove(scene, any));
    tell(asking, espalier_moving_scene_remove(scene, some_handle(asking, bits >> 3)));
    if (bits % 16u == 1u) tell(asking, espalier_moving_scene_remove(scene, some_handle(asking, bits >> 5)));
    tell(asking, espalier_moving_scene_move(scene, any, &place));
    tell(asking, espalier_moving_scene_move(scene, some_handle(asking, bits >> 7), &place));
    tell(asking, espalier_moving_scene_set_mask(scene, some_handle(asking, bits >> 9), bits));
    tell(asking, espalier_moving_scene_set_user(scene, some_handle(asking, bits >> 10), bits));

    espalier_movement movements[4];
    for (uint32_t i = 0; i < 4; ++i) {
        movements[i].instance = some_handle(asking, bits >> i);
        movements[i].transform = some_transform(question, (int)i);
    }
    tell_filled(asking, espalier_moving_scene_move_batch(scene, movements, 4));
    tell(asking, espalier_moving_scene_move_instances_of(scene, (bits >> 4) % 7u));
    tell(asking, espalier_moving_scene_move_instances_of(scene, bits));
    tell(asking, espalier_moving_scene_must_refit(scene));
    if (bits % 8u != 0) tell(asking, espalier_moving_scene_refit(scene));
    if (bits % 16u == 3u) espalier_moving_scene_repack(scene);
    tell_float(asking, espalier_moving_scene_quality(scene));
    if (bits % 3u == 0) espalier_moving_scene_end_step(scene);
}

static void tell_about(struct asking* asking, espalier_instance_handle handle) {
    const espalier_box_result box = espalier_moving_scene_box_of(asking->moving, handle);
    tell_instance_result(asking, espalier_moving_scene_instance_at(asking->moving, handle));
    tell(asking, box.status);
    tell_point(asking, box.value.min);
    tell_point(asking, box.value.max);
}

static void tell_moving_scene(struct asking* asking) {
    const espalier_moving_scene* scene = asking->moving;
    const uint32_t bits = asking->question->bits;
    const espalier_instance_handle any = {bits % 50u, bits >> 30};
    size_t count = 99;
    tell(asking, espalier_moving_scene_is_open(scene));
    tell(asking, espalier_moving_scene_instance_count(scene));
    tell(asking, espalier_moving_scene_capacity(scene));
    tell(asking, espalier_moving_scene_slot_end(scene));
    tell(asking, (uint32_t)espalier_moving_scene_step_exponent(scene));
    tell(asking, espalier_moving_scene_must_refit(scene));
    const unsigned char* block = espalier_moving_scene_block(scene, &count);
    tell(asking, (uint32_t)count);
    for (size_t i = 0; i < count; i += 97) tell(asking, block[i]);
    const espalier_blob* meshes = espalier_moving_scene_meshes(scene, &count);
    tell(asking, (uint32_t)count);
    for (size_t i = 0; i < count; ++i) tell(asking, espalier_blob_checksum(&meshes[i]));
    const espalier_scene* tiles = espalier_moving_scene_tiles(scene, &count);
    tell(asking, (uint32_t)count);
    for (size_t i = 0; i < count; ++i) tell(asking, espalier_scene_size(&tiles[i]));
    for (int shift = 0; shift < 32; shift += 8) {
        tell(asking, (uint32_t)espalier_moving_scene_bytes(bits >> shift));
        tell(asking, (uint32_t)(espalier_least_moving_scene_bytes(bits >> shift) >> 4));
    }
    tell_handle(asking, espalier_moving_scene_handle_of(scene, bits));
    tell_about(asking, some_handle(asking, bits >> 2));
    tell_about(asking, any);
    for (uint32_t slot = 0; slot < 50u; ++slot) {
        const espalier_instance_id id = {slot, bits >> 29}, whole = {slot, 0xFFFFFFFFu};
        tell_instance_result(asking, espalier_moving_scene_instance_of_id(scene, id));
        tell_instance_result(asking, espalier_moving_scene_instance_of_id(scene, whole));
    }
}

void ask_moving_scenes(struct asking* asking) {
    espalier_scene view;
    struct asking of_view = *asking;
    tell_moving_scene(asking);
    tell(asking, espalier_moving_scene_view(asking->moving, &view));
    tell(asking, espalier_scene_status(&view));
    of_view.scene = &view;
    ask_queries_of_scenes(&of_view);
}

static bool keeps(espalier_instance_id a, espalier_instance_id b, void* bits) {
    return (2u * a.index + a.in_tile + b.index + b.in_tile + *(const uint32_t*)bits) % 3u != 0;
}

#define CAPACITY 7

static espalier_instance_pair tell_page(struct asking* asking, espalier_filled_instance_pairs page,
                                        const espalier_instance_pair* pairs) {
    tell(asking, (uint32_t)page.count);
    tell(asking, page.next.a);
    tell(asking, page.next.b);
    tell(asking, page.status);
    for (size_t i = 0; i < page.count; ++i) {
        tell(asking, pairs[i].a);
        tell(asking, pairs[i].b);
    }
    return page.next;
}

static espalier_baked_pair tell_baked_page(struct asking* asking, espalier_filled_baked_pairs page,
                                           const espalier_baked_pair* pairs) {
    tell(asking, (uint32_t)page.count);
    tell(asking, page.next.moving);
    tell_id(asking, page.next.baked);
    tell(asking, page.status);
    for (size_t i = 0; i < page.count; ++i) {
        tell(asking, pairs[i].moving);
        tell_id(asking, pairs[i].baked);
    }
    return page.next;
}

static void ask_pages(struct asking* asking, const espalier_pair_filter* filter) {
    espalier_moving_scene* scene = asking->moving;
    const uint32_t bits = asking->question->bits;
    const espalier_instance_pair begin = {0, 0}, middle = {bits % 40u, bits >> 8}, any = {bits, bits};
    espalier_instance_pair pairs[CAPACITY], from = begin;
    for (int page = 0; page < 3; ++page)
        from = tell_page(asking, espalier_collect_candidate_pairs(scene, pairs, CAPACITY, filter, from), pairs);
    tell_page(asking, espalier_collect_candidate_pairs(scene, pairs, CAPACITY, filter, middle), pairs);
    tell_page(asking, espalier_collect_candidate_pairs(scene, pairs, CAPACITY, filter, any), pairs);
    from = begin;
    for (int page = 0; page < 3; ++page)
        from = tell_page(
            asking, espalier_collect_colliding_pairs(scene, pairs, CAPACITY, ESPALIER_WORK_UNLIMITED, filter, from),
            pairs);
    tell_page(asking, espalier_collect_colliding_pairs(scene, pairs, CAPACITY, bits % 900u, filter, begin), pairs);
    tell_page(asking, espalier_collect_colliding_pairs(scene, pairs, CAPACITY, bits % 900u, filter, any), pairs);
    espalier_scene_counters walk = {0};
    espalier_pair_counters triangles = {0};
    tell_page(asking, espalier_collect_candidate_pairs_counted(scene, pairs, CAPACITY, &walk, filter, middle), pairs);
    tell_page(
        asking,
        espalier_collect_colliding_pairs_counted(scene, pairs, CAPACITY, bits % 900u, &walk, &triangles, filter, begin),
        pairs);
    tell(asking, (uint32_t)walk.box_tests);
    tell(asking, (uint32_t)walk.pairs);
    tell(asking, (uint32_t)triangles.box_pairs);
}

static void ask_baked_pages(struct asking* asking, const espalier_pair_filter* filter) {
    const espalier_moving_scene* moving = asking->moving;
    const espalier_scene* baked = asking->scene;
    const uint32_t bits = asking->question->bits;
    const espalier_baked_pair begin = {0, {0, 0}}, any = {bits % 40u, {bits >> 8, bits}};
    espalier_baked_pair pairs[CAPACITY], from = begin;
    for (int page = 0; page < 3; ++page)
        from = tell_baked_page(
            asking, espalier_collect_candidate_pairs_with_baked(moving, baked, pairs, CAPACITY, filter, from), pairs);
    tell_baked_page(asking, espalier_collect_candidate_pairs_with_baked(moving, baked, pairs, CAPACITY, filter, any),
                    pairs);
    from = begin;
    for (int page = 0; page < 3; ++page)
        from = tell_baked_page(asking,
                               espalier_collect_colliding_pairs_with_baked(moving, baked, pairs, CAPACITY,
                                                                           ESPALIER_WORK_UNLIMITED, filter, from),
                               pairs);
    tell_baked_page(
        asking, espalier_collect_colliding_pairs_with_baked(moving, baked, pairs, CAPACITY, bits % 900u, filter, any),
        pairs);
}

void ask_scene_pairs(struct asking* asking) {
    uint32_t bits = asking->question->bits;
    const espalier_pair_filter moved = {bits % 2u != 0, NULL, NULL}, kept = {bits % 4u < 2u, keeps, &bits};
    const espalier_pair_filter* const filters[] = {NULL, &moved, &kept};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; ++i) {
        ask_pages(asking, filters[i]);
        ask_baked_pages(asking, filters[i]);
    }
}

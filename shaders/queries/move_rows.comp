// Moves bodies to other rows of a step's tables (compute/device/row_mover.h): push.step says which part of the work. Threads take
// further items in turn where there are more than a dispatch has threads.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/record_groups.h"
#include "shaders/physics/base/records.h"
#include "shaders/stages/lib/prefix_sum.glsl"

layout(local_size_x_id = 0) in;

// A table, and its records in their new places.
layout(std430, set = 0, binding = 0) buffer TableNow {
    uint at[];
}
table;
layout(std430, set = 0, binding = 1) buffer TableMoved {
    uint at[];
}
moved;
layout(std430, set = 0, binding = 2) readonly buffer WordsTable {
    uint at[];
}
words;
// By row of all: where it comes from, where it goes to, the first contact that it will own (and the end of all), the sums of
// blocks of the latter.
layout(std430, set = 0, binding = 3) buffer Moves {
    uint at[];
}
moves;

// The same two, four words at once.
layout(std430, set = 0, binding = 4) readonly buffer QuadsNow {
    uvec4 at[];
}
quads;
layout(std430, set = 0, binding = 5) writeonly buffer QuadsMoved {
    uvec4 at[];
}
quads_moved;

// Steps with barriers apart, since lavapipe keeps the variables of all that meet one in memory.
layout(constant_id = 1) const bool SUMS_UP = false;

layout(push_constant) uniform Push {
    uint step;
    uint items;   // rows, records, contacts
    uint rows;    // all
    uint record;  // length of one, words
    uint begin;   // of the table in its buffer, words
    uint first;   // FOLLOW: which word of a record is a row; else begin of first_contacts, words
    uint bodies;  // rows that move are below
    uint shift;   // of groups of contacts (record_groups.h); 0: one after the other
}
push;

const uint GO_TO = 0u;        // notes where rows go to
const uint MOVE = 1u;         // records of bodies
const uint FOLLOW = 2u;       // a word of each record that is a row
const uint COUNT_BLOCK = 3u;  // contacts of each row, summed within its block
const uint SUM_BLOCKS = 4u;   // one workgroup
const uint FIRST = 5u;        // adds these sums
const uint MOVE_CONTACTS = 6u;
const uint ITEMS = 16u;  // rows of a thread in a block

uint from_of(uint row) {
    return moves.at[row];
}
uint to_of(uint row) {
    return row < push.bodies ? moves.at[push.rows + row] : row;
}
uint firsts() {
    return 2u * push.rows;
}
uint sums() {
    return 3u * push.rows + 1u;
}
uint contacts_of(uint row) {
    uint from = from_of(row);
    return words.at[push.first + from + 1u] - words.at[push.first + from];
}

void count_block(uint block) {
    uint first = (block * gl_WorkGroupSize.x + gl_LocalInvocationID.x) * ITEMS, sum = 0u;
    for (uint row = first; row < min(first + ITEMS, push.rows); ++row) sum += contacts_of(row);
    uint before = sum_before(sum);
    if (gl_LocalInvocationID.x == gl_WorkGroupSize.x - 1u) moves.at[sums() + block] = before + sum;
    for (uint row = first; row < min(first + ITEMS, push.rows); ++row) {
        moves.at[firsts() + row] = before;
        before += contacts_of(row);
    }
    barrier();
}

void sum_blocks(uint blocks) {
    uint total = 0u;
    for (uint begin = 0u; begin < blocks; begin += gl_WorkGroupSize.x) {
        uint block = begin + gl_LocalInvocationID.x;
        uint value = block < blocks ? moves.at[sums() + block] : 0u;
        uint before = sum_before(value);
        if (block < blocks) moves.at[sums() + block] = total + before;
        barrier();
        total += partial[gl_WorkGroupSize.x - 1u];
        barrier();
    }
    if (gl_LocalInvocationID.x == 0u) moves.at[firsts() + push.rows] = total;
}

// The row that owns a contact: the last one whose contacts begin at or before it.
uint owner_of(uint contact) {
    uint low = 0u, high = push.rows;
    while (high - low > 1u) {
        uint middle = (low + high) >> 1;
        if (words.at[push.first + middle] <= contact)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void move_record(uint now, uint then) {
    uint words_each = push.record;
    if (((now | then | words_each) & 3u) == 0u) {
        for (uint k = 0u; k < words_each >> 2; ++k) quads_moved.at[(then >> 2) + k] = quads.at[(now >> 2) + k];
    } else {
        for (uint k = 0u; k < words_each; ++k) moved.at[then + k] = table.at[now + k];
    }
}

void move_contact(uint contact) {
    uint owner = owner_of(contact);
    uint place = moves.at[firsts() + to_of(owner)] + contact - words.at[push.first + owner];
    if (push.shift == 0u) {
        move_record(push.begin + contact * push.record, push.begin + place * push.record);
        return;
    }
    uint quads_each = push.record >> 2, begin = push.begin >> 2;
    for (uint k = 0u; k < quads_each; ++k)
        quads_moved.at[begin + place_in_groups(quads_each, place, k, push.shift)] =
            quads.at[begin + place_in_groups(quads_each, contact, k, push.shift)];
}

void main() {
    uint block_rows = gl_WorkGroupSize.x * ITEMS, blocks = (push.rows + block_rows - 1u) / block_rows;
    if (SUMS_UP) {
        if (push.step == SUM_BLOCKS) sum_blocks(blocks);
        if (push.step == COUNT_BLOCK)
            for (uint block = gl_WorkGroupID.x; block < blocks; block += gl_NumWorkGroups.x) count_block(block);
        return;
    }
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_GlobalInvocationID.x; i < push.items; i += stride) {
        if (push.step == GO_TO) {
            moves.at[push.rows + from_of(i)] = i;
        } else if (push.step == MOVE) {
            move_record(push.begin + from_of(i) * push.record, i * push.record);
        } else if (push.step == FOLLOW) {
            uint place = push.begin + i * push.record + push.first;
            table.at[place] = to_of(table.at[place]);
        } else if (push.step == FIRST) {
            moves.at[firsts() + i] += moves.at[sums() + i / block_rows];
        } else if (push.step == MOVE_CONTACTS) {
            move_contact(i);
        }
    }
}

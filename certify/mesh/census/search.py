"""The search (draft)."""
import numpy as np
from certify.mesh.compiled import compiled
from certify.mesh.jacobian import filtered_jacobian, workspace
from certify.mesh.signs import UNKNOWN
from certify.mesh.census.region import region, walk


@compiled
def edge_to(rings, x, p):
    low, high = rings.first[x], rings.first[x + 1]
    while low < high:
        mid = (low + high) >> 1
        if rings.heads[mid] < p:
            low = mid + 1
        else:
            high = mid
    if low < rings.first[x + 1] and rings.heads[low] == p:
        return low
    return -1


@compiled
def on_ring(rings, e, z):
    for k in range(rings.start[e], rings.start[e + 1]):
        if rings.apex[k] == z:
            return k
    return -1


@compiled
def bent(rings, x, a, b, c):
    """Is det(a-x, b-x, c-x) certainly <= 0?"""
    P = rings.points
    x0, x1, x2 = P[x, 0], P[x, 1], P[x, 2]
    a0, a1, a2 = P[a, 0] - x0, P[a, 1] - x1, P[a, 2] - x2
    b0, b1, b2 = P[b, 0] - x0, P[b, 1] - x1, P[b, 2] - x2
    c0, c1, c2 = P[c, 0] - x0, P[c, 1] - x1, P[c, 2] - x2
    value = a0 * (b1 * c2 - b2 * c1) - a1 * (b0 * c2 - b2 * c0) + a2 * (b0 * c1 - b1 * c0)
    return value <= -rings.rounding[x]


@compiled
def quads_at(rings, v, local, raw):
    """Quads at v: raw rows (i, j, s, kind, e(i->s), e(j->s)), i<j local numbers of neighbours (index in rings.first[v]..). Returns raw, count."""
    f0, f1 = rings.first[v], rings.first[v + 1]
    n = 0
    for a in range(f0, f1):
        s = rings.heads[a]
        if s < v:
            continue
        # diagonal v-s: pairs on ring(v->s)
        b0, b1 = rings.start[a], rings.start[a + 1]
        for k in range(b0, b1):
            p = rings.apex[k]
            if p < v:
                continue
            eps = edge_to(rings, p, s)
            ip = local[p]
            for m in range(k + 1, b1):
                q = rings.apex[m]
                if q < v:
                    continue
                iq = local[q]
                kind = 1
                if on_ring(rings, eps, q) >= 0:
                    kk = on_ring(rings, f0 + ip, q)
                    if kk >= 0:
                        kind = 3
                        # tetrahedron v p s q positive?
                        if rings.inner[k] >= 0 and has(rings, rings.inner[k], q):
                            kind = 5
                        elif rings.inner[m] >= 0 and has(rings, rings.inner[m], p):
                            kind = 4
                eqs = edge_to(rings, q, s)
                if n == len(raw):
                    raw = grown(raw)
                raw[n, 2] = s
                if ip < iq:
                    raw[n, 0], raw[n, 1], raw[n, 4], raw[n, 5] = ip, iq, eps, eqs
                    # orientation (v,p,s,q): apex on positive side of (v,s,p)... see below
                    raw[n, 3] = kind
                else:
                    raw[n, 0], raw[n, 1], raw[n, 4], raw[n, 5] = iq, ip, eqs, eps
                    raw[n, 3] = 9 - kind if kind > 3 else kind
                n += 1
    for a in range(f0, f1):
        p = rings.heads[a]
        if p < v:
            continue
        ip = a - f0
        for k in range(rings.start[a], rings.start[a + 1]):
            q = rings.apex[k]
            if q < p:
                continue
            iq = local[q]
            epq = edge_to(rings, p, q)
            for m in range(rings.start[epq], rings.start[epq + 1]):
                s = rings.apex[m]
                if s <= v:
                    continue
                if on_ring(rings, a, s) >= 0 and on_ring(rings, f0 + iq, s) >= 0:
                    continue
                if n == len(raw):
                    raw = grown(raw)
                raw[n, 0], raw[n, 1], raw[n, 2], raw[n, 3] = ip, iq, s, 2
                raw[n, 4], raw[n, 5] = edge_to(rings, p, s), edge_to(rings, q, s)
                n += 1
    return raw, n


@compiled
def has(rings, t, x):
    for i in range(4):
        if rings.tetrahedra[t, i] == x:
            return True
    return False


@compiled
def grown(rows):
    out = np.empty((2 * len(rows), rows.shape[1]), rows.dtype)
    out[: len(rows)] = rows
    return out


@compiled
def facet(rings, eab, ead, ecd_unused, b, d, c, a):
    return 0


@compiled
def search(rings, table, begin, end):
    count = len(rings.first) - 1
    local = np.full(count, -1, np.int32)
    raw = np.empty((1024, 6), np.int32)
    memory = walk(count)
    boxes, edges = workspace()
    points = np.empty((8, 3))
    eight = np.empty(8, np.int32)
    kinds = np.zeros(6, np.int32)
    out = np.empty((1024, 9), np.int32)
    found = 0
    stat = np.zeros(16, np.int64)
    most = 0
    for e in range(len(rings.heads)):
        most = max(most, rings.start[e + 1] - rings.start[e])
    ts = np.empty(2 * most + 2, np.int32)
    tk = np.empty(2 * most + 2, np.int32)
    for v in range(begin, end):
        f0, f1 = rings.first[v], rings.first[v + 1]
        d = f1 - f0
        for i in range(d):
            local[rings.heads[f0 + i]] = i
        raw, n = quads_at(rings, v, local, raw)
        stat[0] += n
        # entries sorted by (i, j): row: j, s, kind, near edge, far edge
        beg = np.zeros(d + 1, np.int32)
        for k in range(n):
            beg[raw[k, 0] + 1] += 1
            beg[raw[k, 1] + 1] += 1
        for i in range(d):
            beg[i + 1] += beg[i]
        byj = np.empty((2 * n, 6), np.int32)
        fill = beg.copy()
        for k in range(n):  # first by j
            j = raw[k, 1]
            m = fill[j]
            fill[j] += 1
            byj[m, 0], byj[m, 1], byj[m, 2], byj[m, 3], byj[m, 4], byj[m, 5] = raw[k, 0], j, raw[k, 2], raw[k, 3], raw[k, 4], raw[k, 5]
            j = raw[k, 0]
            m = fill[j]
            fill[j] += 1
            kd = raw[k, 3]
            byj[m, 0], byj[m, 1], byj[m, 2], byj[m, 3], byj[m, 4], byj[m, 5] = raw[k, 1], j, raw[k, 2], 9 - kd if kd > 3 else kd, raw[k, 5], raw[k, 4]
        ent = np.empty((2 * n, 6), np.int32)
        fill[:] = beg
        for k in range(2 * n):
            m = fill[byj[k, 0]]
            fill[byj[k, 0]] += 1
            ent[m] = byj[k]
        # runs
        nr = 0
        rb = np.empty(2 * n + 1, np.int32)   # start of run
        rfirst = np.empty(d + 1, np.int32)
        for i in range(d):
            rfirst[i] = nr
            for k in range(beg[i], beg[i + 1]):
                if k == beg[i] or ent[k, 1] != ent[k - 1, 1]:
                    rb[nr] = k
                    nr += 1
        rfirst[d] = nr
        rb[nr] = 2 * n
        mark = np.full(d, -1, np.int32)
        for qi in range(d):
            q = rings.heads[f0 + qi]
            for ra in range(rfirst[qi], rfirst[qi + 1]):
                pi = ent[rb[ra], 1]
                if pi < qi:
                    continue
                p = rings.heads[f0 + pi]
                for rc in range(rfirst[pi], rfirst[pi + 1]):
                    mark[ent[rb[rc], 1]] = rc
                for rr in range(rfirst[qi], rfirst[qi + 1]):
                    ri = ent[rb[rr], 1]
                    if ri < qi or ri == pi or mark[ri] < 0:
                        continue
                    r = rings.heads[f0 + ri]
                    stat[1] += 1
                    if bent(rings, v, p, q, r):
                        continue
                    stat[2] += 1
                    rc = mark[ri]
                    for A in range(rb[ra], rb[ra + 1]):
                        s1 = ent[A, 2]
                        if s1 == r:
                            continue
                        for B in range(rb[rr], rb[rr + 1]):
                            s2 = ent[B, 2]
                            if s2 == p or s2 == s1:
                                continue
                            stat[3] += 1
                            if bent(rings, q, v, s1, s2):
                                continue
                            stat[4] += 1
                            eq1, eq2 = ent[A, 4], ent[B, 4]
                            nt = 0
                            for k in range(rings.start[eq1], rings.start[eq1 + 1]):
                                t = rings.apex[k]
                                if t > v and t != p and t != r and t != s2:
                                    if on_ring(rings, eq2, t) >= 0:
                                        ts[nt] = t
                                        tk[nt] = 2
                                        nt += 1
                            if on_ring(rings, eq1, s2) >= 0:
                                e12 = edge_to(rings, s1, s2)
                                n0 = nt
                                for k in range(rings.start[e12], rings.start[e12 + 1]):
                                    t = rings.apex[k]
                                    if t > v and t != p and t != r and t != q:
                                        dup = False
                                        for m in range(n0):
                                            if ts[m] == t:
                                                tk[m] = 3
                                                dup = True
                                        if not dup:
                                            ts[nt] = t
                                            tk[nt] = 1
                                            nt += 1
                            stat[5] += nt > 0
                            stat[6] += nt
                            n1 = 0
                            for m in range(nt):
                                t = ts[m]
                                if bent(rings, s1, q, p, t) or bent(rings, s2, r, q, t):
                                    continue
                                ts[n1] = t
                                tk[n1] = tk[m]
                                n1 += 1
                            stat[7] += n1
                            if n1 == 0:
                                continue
                            ep1, er2 = ent[A, 5], ent[B, 5]
                            for C in range(rb[rc], rb[rc + 1]):
                                s3 = ent[C, 2]
                                if s3 == q or s3 == s1 or s3 == s2:
                                    continue
                                stat[8] += 1
                                if bent(rings, p, v, s3, s1) or bent(rings, r, v, s2, s3):
                                    continue
                                stat[9] += 1
                                ep3, er3 = ent[C, 4], ent[C, 5]
                                p13 = on_ring(rings, ep1, s3) >= 0
                                r23 = on_ring(rings, er2, s3) >= 0
                                for m in range(n1):
                                    t = ts[m]
                                    if t == s3:
                                        continue
                                    stat[10] += 1
                                    k3 = 0
                                    if on_ring(rings, ep1, t) >= 0 and on_ring(rings, ep3, t) >= 0:
                                        k3 = 1
                                    if p13 and on_ring(rings, edge_to(rings, s1, s3), t) >= 0:
                                        k3 |= 2
                                    if k3 == 0:
                                        continue
                                    k5 = 0
                                    if on_ring(rings, er2, t) >= 0 and on_ring(rings, er3, t) >= 0:
                                        k5 = 1
                                    if r23 and on_ring(rings, edge_to(rings, s2, s3), t) >= 0:
                                        k5 |= 2
                                    if k5 == 0:
                                        continue
                                    stat[11] += 1
                                    if bent(rings, s3, p, r, t) or bent(rings, t, s1, s3, s2):
                                        continue
                                    stat[12] += 1
                                    eight[0], eight[1], eight[2], eight[3] = v, p, s1, q
                                    eight[4], eight[5], eight[6], eight[7] = r, s3, t, s2
                                    # kinds: A at q with j=p is oriented (v,q,s1,p)->reverse for (v,p,s1,q)
                                    kA, kB, kC = ent[A, 3], ent[B, 3], ent[C, 3]
                                    kinds[0], kinds[2], kinds[1] = min(kA, 3), min(kB, 3), min(kC, 3)
                                    kinds[3], kinds[4], kinds[5] = k3, tk[m], k5
                                    for i in range(8):
                                        for ax in range(3):
                                            points[i, ax] = rings.points[eight[i], ax]
                                    sign = filtered_jacobian(points, boxes, edges)
                                    if sign == -1:
                                        continue
                                    stat[13] += 1
                                    # start
                                    kd = 9 - kA if kA > 3 else kA
                                    own = -1
                                    evp = f0 + pi
                                    if kd == 1 or kd == 3 or kd == 5:
                                        own = region(rings, table, memory, eight, kinds, rings.inner[on_ring(rings, evp, s1)])
                                    if own < 0 and (kd == 2 or kd == 3 or kd == 4):
                                        own = region(rings, table, memory, eight, kinds, rings.inner[on_ring(rings, evp, q)])
                                    if own < 0:
                                        continue
                                    stat[14] += 1
                                    if found == len(out):
                                        out = grown(out)
                                    out[found, :8] = eight
                                    out[found, 8] = own if sign == 1 else -1 - own
                                    found += 1
                for rc in range(rfirst[pi], rfirst[pi + 1]):
                    mark[ent[rb[rc], 1]] = -1
        for i in range(d):
            local[rings.heads[f0 + i]] = -1
    return out[:found], stat

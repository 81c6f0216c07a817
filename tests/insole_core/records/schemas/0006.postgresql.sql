--
-- PostgreSQL database dump
--


SET statement_timeout = 0;
SET lock_timeout = 0;
SET idle_in_transaction_session_timeout = 0;
SET client_encoding = 'UTF8';
SET standard_conforming_strings = on;
SET check_function_bodies = false;
SET xmloption = content;
SET client_min_messages = warning;
SET row_security = off;

--
-- Name: check_audit_head(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.check_audit_head() RETURNS trigger
    LANGUAGE plpgsql
    AS $$ BEGIN IF NEW.id <> OLD.id OR NEW.seq <= OLD.seq THEN RAISE EXCEPTION 'the audit log is only appended to'; END IF; RETURN NEW; END $$;


--
-- Name: check_version_delete(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.check_version_delete() RETURNS trigger
    LANGUAGE plpgsql
    AS $$ BEGIN IF OLD.is_closed AND NOT EXISTS (SELECT 1 FROM visits JOIN persons ON persons.id = visits.person_id WHERE visits.id = OLD.visit_id AND persons.is_erased) THEN RAISE EXCEPTION 'a closed or signed prescription cannot be changed'; END IF; RETURN OLD; END $$;


--
-- Name: check_version_update(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.check_version_update() RETURNS trigger
    LANGUAGE plpgsql
    AS $$ BEGIN IF (OLD.is_closed AND (OLD.id IS DISTINCT FROM NEW.id OR OLD.visit_id IS DISTINCT FROM NEW.visit_id OR OLD.side IS DISTINCT FROM NEW.side OR OLD.number IS DISTINCT FROM NEW.number OR OLD.mesh_sha256 IS DISTINCT FROM NEW.mesh_sha256 OR OLD.capture_id IS DISTINCT FROM NEW.capture_id OR OLD.author IS DISTINCT FROM NEW.author OR OLD.station IS DISTINCT FROM NEW.station OR OLD.program_version IS DISTINCT FROM NEW.program_version OR OLD.created_at IS DISTINCT FROM NEW.created_at OR OLD.changed_at IS DISTINCT FROM NEW.changed_at OR OLD.is_closed IS DISTINCT FROM NEW.is_closed OR ((OLD.document IS DISTINCT FROM NEW.document OR OLD.reason IS DISTINCT FROM NEW.reason) AND NOT EXISTS (SELECT 1 FROM visits JOIN persons ON persons.id = visits.person_id WHERE visits.id = OLD.visit_id AND persons.is_erased)))) OR (OLD.signature IS NOT NULL AND (OLD.signature IS DISTINCT FROM NEW.signature OR OLD.signed_by IS DISTINCT FROM NEW.signed_by OR OLD.signed_at IS DISTINCT FROM NEW.signed_at)) THEN RAISE EXCEPTION 'a closed or signed prescription cannot be changed'; END IF; RETURN NEW; END $$;


--
-- Name: refuse_audit_change(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.refuse_audit_change() RETURNS trigger
    LANGUAGE plpgsql
    AS $$ BEGIN IF true THEN RAISE EXCEPTION 'the audit log is only appended to'; END IF; RETURN NEW; END $$;


--
-- Name: write_person_words(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.write_person_words() RETURNS trigger
    LANGUAGE plpgsql
    AS $$ BEGIN IF TG_OP <> 'INSERT' THEN DELETE FROM person_words WHERE person_id = OLD.id AND word = ANY (string_to_array(OLD.search_text, ' ')); END IF; IF TG_OP = 'DELETE' THEN RETURN OLD; END IF; INSERT INTO person_words (word, person_id) SELECT DISTINCT word, NEW.id FROM unnest(string_to_array(NEW.search_text, ' ')) AS word WHERE word <> ''; RETURN NEW; END $$;


SET default_tablespace = '';

SET default_table_access_method = heap;

--
-- Name: accounts; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.accounts (
    id text NOT NULL,
    name text NOT NULL,
    full_name text NOT NULL,
    role text NOT NULL,
    password_hash text NOT NULL,
    failures integer DEFAULT 0 NOT NULL,
    locked_until text,
    is_disabled boolean DEFAULT false NOT NULL,
    changed_at text NOT NULL,
    must_change_password boolean DEFAULT false NOT NULL,
    system_user text
);


--
-- Name: alembic_version; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.alembic_version (
    version_num character varying(32) NOT NULL
);


--
-- Name: audit; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.audit (
    seq bigint NOT NULL,
    at text NOT NULL,
    author text NOT NULL,
    station text NOT NULL,
    action text NOT NULL,
    subject_kind text NOT NULL,
    subject_id text NOT NULL,
    details text DEFAULT '{}'::text NOT NULL,
    previous_hash text NOT NULL,
    hash text NOT NULL
);


--
-- Name: audit_head; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.audit_head (
    id integer NOT NULL,
    seq bigint NOT NULL,
    hash text NOT NULL
);


--
-- Name: captures; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.captures (
    id text NOT NULL,
    visit_id text NOT NULL,
    number integer NOT NULL,
    kind text NOT NULL,
    file_name text NOT NULL,
    content_sha256 text NOT NULL,
    source_sha256 text DEFAULT ''::text NOT NULL,
    recorded_at text DEFAULT ''::text NOT NULL,
    sensor_serials text DEFAULT '[]'::text NOT NULL,
    calibrated_on text DEFAULT ''::text NOT NULL,
    calibration_residuals text DEFAULT '{}'::text NOT NULL,
    report text DEFAULT '{}'::text NOT NULL,
    program_version text NOT NULL,
    created_at text NOT NULL,
    author text NOT NULL
);


--
-- Name: clinic; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.clinic (
    key text NOT NULL,
    value text NOT NULL
);


--
-- Name: contents; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.contents (
    sha256 text NOT NULL,
    size bigint NOT NULL,
    kind text NOT NULL,
    created_at text NOT NULL
);


--
-- Name: follow_ups; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.follow_ups (
    id text NOT NULL,
    person_id text NOT NULL,
    order_id text,
    visit_id text,
    on_date date NOT NULL,
    outcome text DEFAULT ''::text NOT NULL,
    notes text DEFAULT ''::text NOT NULL,
    author text NOT NULL,
    created_at text NOT NULL
);


--
-- Name: merges; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.merges (
    id text NOT NULL,
    kept_id text NOT NULL,
    merged_id text NOT NULL,
    moved text NOT NULL,
    at text NOT NULL,
    author text NOT NULL,
    undone_at text
);


--
-- Name: order_events; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.order_events (
    order_id text NOT NULL,
    seq integer NOT NULL,
    at text NOT NULL,
    author text NOT NULL,
    from_state text,
    to_state text NOT NULL,
    remarks text DEFAULT ''::text NOT NULL,
    release integer DEFAULT 1 NOT NULL
);


--
-- Name: order_feet; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.order_feet (
    order_id text NOT NULL,
    prescription_version_id text NOT NULL,
    release integer DEFAULT 1 NOT NULL
);


--
-- Name: order_files; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.order_files (
    order_id text NOT NULL,
    name text NOT NULL,
    content_sha256 text NOT NULL,
    size bigint NOT NULL,
    release integer DEFAULT 1 NOT NULL
);


--
-- Name: orders; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.orders (
    id text NOT NULL,
    number text NOT NULL,
    visit_id text NOT NULL,
    person_id text NOT NULL,
    state text NOT NULL,
    shop text DEFAULT ''::text NOT NULL,
    due_on date,
    remarks text DEFAULT ''::text NOT NULL,
    created_at text NOT NULL,
    changed_at text NOT NULL,
    revision integer NOT NULL,
    release integer DEFAULT 1 NOT NULL,
    place text DEFAULT ''::text NOT NULL
);


--
-- Name: person_words; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.person_words (
    word text NOT NULL COLLATE pg_catalog."C",
    person_id text NOT NULL
);


--
-- Name: persons; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.persons (
    id text NOT NULL,
    name text NOT NULL,
    search_text text NOT NULL COLLATE pg_catalog."C",
    sort_key text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    birth_date date,
    personal_number text DEFAULT ''::text NOT NULL,
    number_kind text DEFAULT ''::text NOT NULL,
    contact text DEFAULT ''::text NOT NULL,
    notes text DEFAULT ''::text NOT NULL,
    consent_on date,
    pseudonym text NOT NULL,
    is_erased boolean DEFAULT false NOT NULL,
    merged_into text,
    last_seq bigint DEFAULT '0'::bigint NOT NULL,
    created_at text NOT NULL,
    changed_at text NOT NULL,
    revision integer NOT NULL,
    name_key text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    salt text DEFAULT ''::text NOT NULL,
    occupation text DEFAULT ''::text NOT NULL
);


--
-- Name: prescription_versions; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.prescription_versions (
    id text NOT NULL,
    visit_id text NOT NULL,
    side text NOT NULL,
    number integer NOT NULL,
    document text NOT NULL,
    mesh_sha256 text NOT NULL,
    capture_id text,
    author text NOT NULL,
    station text NOT NULL,
    reason text DEFAULT ''::text NOT NULL,
    program_version text NOT NULL,
    created_at text NOT NULL,
    changed_at text NOT NULL,
    revision integer NOT NULL,
    is_closed boolean DEFAULT false NOT NULL,
    signed_by text,
    signed_at text,
    signature text
);


--
-- Name: presence; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.presence (
    visit_id text NOT NULL,
    station text NOT NULL,
    author text NOT NULL,
    since text NOT NULL,
    seen_at text NOT NULL
);


--
-- Name: visit_photos; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.visit_photos (
    id text NOT NULL,
    visit_id text NOT NULL,
    number integer NOT NULL,
    content_sha256 text NOT NULL,
    caption text DEFAULT ''::text NOT NULL,
    marks text DEFAULT '[]'::text NOT NULL,
    created_at text NOT NULL,
    changed_at text NOT NULL,
    revision integer NOT NULL,
    author text NOT NULL
);


--
-- Name: visits; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.visits (
    id text NOT NULL,
    person_id text NOT NULL,
    visited_on date NOT NULL,
    reason text DEFAULT ''::text NOT NULL,
    findings text DEFAULT ''::text NOT NULL,
    weight_kg double precision,
    shoe_size_eu double precision,
    measures text DEFAULT '{}'::text NOT NULL,
    capture_state text DEFAULT 'none'::text NOT NULL,
    created_at text NOT NULL,
    changed_at text NOT NULL,
    revision integer NOT NULL,
    terms text DEFAULT '{}'::text NOT NULL
);


--
-- Data for Name: accounts; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: alembic_version; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.alembic_version VALUES ('0006');


--
-- Data for Name: audit; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.audit VALUES (1, '2026-11-22T16:15:35.139641Z', 'anna', 'desk', 'added', 'person', '78d90da7-86c2-44d9-b484-8295e88e543b', '{}', '0000000000000000000000000000000000000000000000000000000000000000', 'a0f3a5148b7a11388c55d9ff478a6e436115d9008f4c457dd0c87211827a0f09');
INSERT INTO public.audit VALUES (2, '2026-11-22T16:15:35.167921Z', 'anna', 'desk', 'added', 'visit', 'c9228e99-9f12-42c6-9cff-04500b2386cb', '{"person":"78d90da7-86c2-44d9-b484-8295e88e543b"}', 'a0f3a5148b7a11388c55d9ff478a6e436115d9008f4c457dd0c87211827a0f09', 'fe9e2542026f60d9ee2cbf4d2f7428c7899f19da7aa60946014d6fd8d5a9e3fd');
INSERT INTO public.audit VALUES (3, '2026-11-22T16:15:35.291659Z', 'anna', 'desk', 'changed', 'prescription', 'a8c06d9e-55fe-4bed-bc79-19c6314df1ee', '{"revision":1,"side":"left"}', 'fe9e2542026f60d9ee2cbf4d2f7428c7899f19da7aa60946014d6fd8d5a9e3fd', 'ab22e4187701b782cbdc4fe3fb1b62ef08ab35890005e5702e0c76179a77b371');
INSERT INTO public.audit VALUES (4, '2026-11-22T16:15:35.339396Z', 'anna', 'desk', 'added', 'order', '72f2d570-92d9-4e9c-a048-691f1cabe677', '{"visit":"c9228e99-9f12-42c6-9cff-04500b2386cb"}', 'ab22e4187701b782cbdc4fe3fb1b62ef08ab35890005e5702e0c76179a77b371', 'f8998ce00ceaadffa4dbc3cc28f1fd061aa507fd16834ece66f487467be992ef');
INSERT INTO public.audit VALUES (5, '2026-11-22T16:15:35.359138Z', 'anna', 'desk', 'seen', 'person', '78d90da7-86c2-44d9-b484-8295e88e543b', '{}', 'f8998ce00ceaadffa4dbc3cc28f1fd061aa507fd16834ece66f487467be992ef', '545455d4c5bbf17bb216f66429321b6f8fd9f41b0664f85cdb9a5df4a038dda4');
INSERT INTO public.audit VALUES (6, '2026-11-26T16:10:53.726842Z', 'Insole Studio', 'vm', 'sealed', 'person', 'rows', '{"78d90da7-86c2-44d9-b484-8295e88e543b":"f103b65fe0aee4f97d1ffb7b6785da89"}', '545455d4c5bbf17bb216f66429321b6f8fd9f41b0664f85cdb9a5df4a038dda4', 'db79dcaa7c4ed56a782cfce19bd7eaf794e58e7e628b27f62d4edc3818fe250e');
INSERT INTO public.audit VALUES (7, '2026-11-26T16:10:53.750321Z', 'Insole Studio', 'vm', 'sealed', 'visit', 'rows', '{"c9228e99-9f12-42c6-9cff-04500b2386cb":"50491412e37d3dd6b01777172e3d848a"}', 'db79dcaa7c4ed56a782cfce19bd7eaf794e58e7e628b27f62d4edc3818fe250e', 'c094cd4134097d788f9c9cdb71ec80f9953c7c7a15e404f7435c44a3bd48be2f');
INSERT INTO public.audit VALUES (8, '2026-11-26T16:10:53.761307Z', 'Insole Studio', 'vm', 'sealed', 'prescription', 'rows', '{"a8c06d9e-55fe-4bed-bc79-19c6314df1ee":"607d976f5e55cc30e43fbcb2a85911c3"}', 'c094cd4134097d788f9c9cdb71ec80f9953c7c7a15e404f7435c44a3bd48be2f', 'dd1f5409752259e1c6c537b021421cc2822f36e66489597402a9ca2948835732');
INSERT INTO public.audit VALUES (9, '2026-11-26T16:10:53.796216Z', 'Insole Studio', 'vm', 'sealed', 'order', 'rows', '{"72f2d570-92d9-4e9c-a048-691f1cabe677":"8bd53ae476e04b0cd02be61fa5163429"}', 'dd1f5409752259e1c6c537b021421cc2822f36e66489597402a9ca2948835732', '3cde638f06ead57438859ddf7dab20aecfb88e62889fb526ac8e6c420ee6ae87');
INSERT INTO public.audit VALUES (10, '2026-11-26T16:10:53.821773Z', 'Insole Studio', 'vm', 'sealed', 'clinic', 'rows', '{"contents_identity":"c3bfef1ca0093453b0f5d82d4dcafa3e"}', '3cde638f06ead57438859ddf7dab20aecfb88e62889fb526ac8e6c420ee6ae87', 'f4aa9c59f6d3014c400a25052fd80ed86c395c18607bc498ef24ba50977ab3fa');


--
-- Data for Name: audit_head; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.audit_head VALUES (1, 10, 'f4aa9c59f6d3014c400a25052fd80ed86c395c18607bc498ef24ba50977ab3fa');


--
-- Data for Name: captures; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: clinic; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.clinic VALUES ('contents_identity', '"f3bc1a38-c33f-4af1-a536-cfcdea74f54a"');


--
-- Data for Name: contents; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.contents VALUES ('f710c3b7842b09462a9125d0529e2337f9411a76608cbd36234727579d27becf', 312785, 'mesh', '2026-11-22T16:15:35.281053Z');


--
-- Data for Name: follow_ups; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: merges; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: order_events; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.order_events VALUES ('72f2d570-92d9-4e9c-a048-691f1cabe677', 1, '2026-11-22T16:15:35.326811Z', 'anna', NULL, 'designed', '', 1);


--
-- Data for Name: order_feet; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.order_feet VALUES ('72f2d570-92d9-4e9c-a048-691f1cabe677', 'a8c06d9e-55fe-4bed-bc79-19c6314df1ee', 1);


--
-- Data for Name: order_files; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: orders; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.orders VALUES ('72f2d570-92d9-4e9c-a048-691f1cabe677', '26-KC42N', 'c9228e99-9f12-42c6-9cff-04500b2386cb', '78d90da7-86c2-44d9-b484-8295e88e543b', 'designed', 'CNC', '2026-12-01', '', '2026-11-22T16:15:35.294800Z', '2026-11-22T16:15:35.294800Z', 1, 1, '');


--
-- Data for Name: person_words; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.person_words VALUES ('anna', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('19700228', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('26-kc42n', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('700228', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('198112289874', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('dnpcnjvt', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('berg', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('kc42n', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('p-dnpcnjvt', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('9874', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('8112289874', '78d90da7-86c2-44d9-b484-8295e88e543b');
INSERT INTO public.person_words VALUES ('28021970', '78d90da7-86c2-44d9-b484-8295e88e543b');


--
-- Data for Name: persons; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.persons VALUES ('78d90da7-86c2-44d9-b484-8295e88e543b', 'Anna Berg', ' anna berg 19700228 700228 28021970 198112289874 8112289874 9874 p-dnpcnjvt dnpcnjvt 26-kc42n kc42n', 'anna berg', '1970-02-28', '19811228-9874', 'se', '', '', NULL, 'P-DNPCNJVT', false, NULL, 5, '2026-11-22T16:15:35.127563Z', '2026-11-22T16:15:35.127563Z', 1, 'anna berg', 'f060e66dc6f1454f83e3dd56289da3a4', '');


--
-- Data for Name: prescription_versions; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.prescription_versions VALUES ('a8c06d9e-55fe-4bed-bc79-19c6314df1ee', 'c9228e99-9f12-42c6-9cff-04500b2386cb', 'left', 1, '{"side": "left", "length_mm": 245.23449920464157, "source2insole": [[0.9990730294724757, -0.04300986183341374, -0.001798211823092699, -3.436813259204993], [0.0430449224916815, 0.9985941242955774, 0.030933954969163308, 121.74572312376779], [0.00046521863159445153, -0.030982683993155773, 0.9995198131423932, 0.20500090028788567], [0.0, 0.0, 0.0, 1.0]], "notes": ["A left foot by its shape: seen from above with the toes ahead, the big toe and the high side of the arch lie on the right (margin 2.7 to 1).", "2 small pieces that float beside the foot left out."], "source": {"kind": "mesh", "path": "l.stl", "sha256": "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "recorded_at": ""}, "annotations": {"key_points": []}, "variants": [{"name": "A", "design": {"format": "insole-design", "version": 1, "side": "left", "corrections": [], "thickness_mm": 3.0, "grid_mm": 1.0, "max_height_mm": 30.0, "margin_mm": 10.0, "outline": {"source": "foot", "extent": "full", "toe_allowance_mm": 5.0, "ball_allowance_mm": 2.0, "heel_allowance_mm": 2.0}, "layers": {"cover_mm": 0.0, "shell_mm": 0.0, "base_mm": 0.0, "cover_is_taken_off": false}, "bottom": "flat", "device": ""}}], "chosen": "A"}', 'f710c3b7842b09462a9125d0529e2337f9411a76608cbd36234727579d27becf', NULL, 'anna', 'desk', '', '0.1.0', '2026-11-22T16:15:35.285094Z', '2026-11-22T16:15:35.285094Z', 1, true, NULL, NULL, NULL);


--
-- Data for Name: presence; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: visit_photos; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: visits; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.visits VALUES ('c9228e99-9f12-42c6-9cff-04500b2386cb', '78d90da7-86c2-44d9-b484-8295e88e543b', '2026-11-20', '', 'flat foot', 70.5, NULL, '{}', 'none', '2026-11-22T16:15:35.144194Z', '2026-11-22T16:15:35.144194Z', 1, '{}');


--
-- Name: alembic_version alembic_version_pkc; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.alembic_version
    ADD CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num);


--
-- Name: accounts pk_accounts; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.accounts
    ADD CONSTRAINT pk_accounts PRIMARY KEY (id);


--
-- Name: audit pk_audit; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.audit
    ADD CONSTRAINT pk_audit PRIMARY KEY (seq);


--
-- Name: audit_head pk_audit_head; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.audit_head
    ADD CONSTRAINT pk_audit_head PRIMARY KEY (id);


--
-- Name: captures pk_captures; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.captures
    ADD CONSTRAINT pk_captures PRIMARY KEY (id);


--
-- Name: clinic pk_clinic; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.clinic
    ADD CONSTRAINT pk_clinic PRIMARY KEY (key);


--
-- Name: contents pk_contents; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.contents
    ADD CONSTRAINT pk_contents PRIMARY KEY (sha256);


--
-- Name: follow_ups pk_follow_ups; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.follow_ups
    ADD CONSTRAINT pk_follow_ups PRIMARY KEY (id);


--
-- Name: merges pk_merges; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.merges
    ADD CONSTRAINT pk_merges PRIMARY KEY (id);


--
-- Name: order_events pk_order_events; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_events
    ADD CONSTRAINT pk_order_events PRIMARY KEY (order_id, seq);


--
-- Name: order_feet pk_order_feet; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_feet
    ADD CONSTRAINT pk_order_feet PRIMARY KEY (order_id, prescription_version_id, release);


--
-- Name: order_files pk_order_files; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_files
    ADD CONSTRAINT pk_order_files PRIMARY KEY (order_id, name, release);


--
-- Name: orders pk_orders; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.orders
    ADD CONSTRAINT pk_orders PRIMARY KEY (id);


--
-- Name: person_words pk_person_words; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.person_words
    ADD CONSTRAINT pk_person_words PRIMARY KEY (word, person_id);


--
-- Name: persons pk_persons; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.persons
    ADD CONSTRAINT pk_persons PRIMARY KEY (id);


--
-- Name: prescription_versions pk_prescription_versions; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.prescription_versions
    ADD CONSTRAINT pk_prescription_versions PRIMARY KEY (id);


--
-- Name: presence pk_presence; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.presence
    ADD CONSTRAINT pk_presence PRIMARY KEY (visit_id, station, author);


--
-- Name: visit_photos pk_visit_photos; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.visit_photos
    ADD CONSTRAINT pk_visit_photos PRIMARY KEY (id);


--
-- Name: visits pk_visits; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.visits
    ADD CONSTRAINT pk_visits PRIMARY KEY (id);


--
-- Name: accounts uq_accounts_name; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.accounts
    ADD CONSTRAINT uq_accounts_name UNIQUE (name);


--
-- Name: captures uq_captures_visit_id_number; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.captures
    ADD CONSTRAINT uq_captures_visit_id_number UNIQUE (visit_id, number);


--
-- Name: orders uq_orders_number; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.orders
    ADD CONSTRAINT uq_orders_number UNIQUE (number);


--
-- Name: persons uq_persons_pseudonym; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.persons
    ADD CONSTRAINT uq_persons_pseudonym UNIQUE (pseudonym);


--
-- Name: prescription_versions uq_prescription_versions_visit_id_side_number; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.prescription_versions
    ADD CONSTRAINT uq_prescription_versions_visit_id_side_number UNIQUE (visit_id, side, number);


--
-- Name: visit_photos uq_visit_photos_visit_id_number; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.visit_photos
    ADD CONSTRAINT uq_visit_photos_visit_id_number UNIQUE (visit_id, number);


--
-- Name: ix_accounts_system_user; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX ix_accounts_system_user ON public.accounts USING btree (system_user);


--
-- Name: ix_audit_at_seq; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_audit_at_seq ON public.audit USING btree (at, seq);


--
-- Name: ix_audit_author_seq; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_audit_author_seq ON public.audit USING btree (author, seq);


--
-- Name: ix_audit_subject_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_audit_subject_id ON public.audit USING btree (subject_id);


--
-- Name: ix_captures_content_sha256; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_captures_content_sha256 ON public.captures USING btree (content_sha256);


--
-- Name: ix_follow_ups_order_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_follow_ups_order_id ON public.follow_ups USING btree (order_id);


--
-- Name: ix_follow_ups_person_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_follow_ups_person_id ON public.follow_ups USING btree (person_id);


--
-- Name: ix_follow_ups_visit_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_follow_ups_visit_id ON public.follow_ups USING btree (visit_id);


--
-- Name: ix_merges_kept_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_merges_kept_id ON public.merges USING btree (kept_id);


--
-- Name: ix_merges_merged_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_merges_merged_id ON public.merges USING btree (merged_id);


--
-- Name: ix_order_feet_prescription_version_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_order_feet_prescription_version_id ON public.order_feet USING btree (prescription_version_id);


--
-- Name: ix_order_files_content_sha256; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_order_files_content_sha256 ON public.order_files USING btree (content_sha256);


--
-- Name: ix_orders_person_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_orders_person_id ON public.orders USING btree (person_id);


--
-- Name: ix_orders_state_due_on; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_orders_state_due_on ON public.orders USING btree (state, due_on);


--
-- Name: ix_orders_visit_id; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_orders_visit_id ON public.orders USING btree (visit_id);


--
-- Name: ix_persons_last_seq; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_persons_last_seq ON public.persons USING btree (last_seq);


--
-- Name: ix_persons_merged_into; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_persons_merged_into ON public.persons USING btree (merged_into);


--
-- Name: ix_persons_name_key_birth_date; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_persons_name_key_birth_date ON public.persons USING btree (name_key, birth_date);


--
-- Name: ix_persons_personal_number; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_persons_personal_number ON public.persons USING btree (personal_number);


--
-- Name: ix_persons_sort_key; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_persons_sort_key ON public.persons USING btree (sort_key);


--
-- Name: ix_prescription_versions_mesh_sha256; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_prescription_versions_mesh_sha256 ON public.prescription_versions USING btree (mesh_sha256);


--
-- Name: ix_visit_photos_content_sha256; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_visit_photos_content_sha256 ON public.visit_photos USING btree (content_sha256);


--
-- Name: ix_visits_capture_state; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_visits_capture_state ON public.visits USING btree (capture_state);


--
-- Name: ix_visits_person_id_visited_on; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_visits_person_id_visited_on ON public.visits USING btree (person_id, visited_on);


--
-- Name: ix_visits_visited_on; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX ix_visits_visited_on ON public.visits USING btree (visited_on);


--
-- Name: audit audit_change; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER audit_change BEFORE DELETE OR UPDATE ON public.audit FOR EACH ROW EXECUTE FUNCTION public.refuse_audit_change();


--
-- Name: audit_head audit_head_delete; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER audit_head_delete BEFORE DELETE ON public.audit_head FOR EACH ROW EXECUTE FUNCTION public.refuse_audit_change();


--
-- Name: audit_head audit_head_update; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER audit_head_update BEFORE UPDATE ON public.audit_head FOR EACH ROW EXECUTE FUNCTION public.check_audit_head();


--
-- Name: audit audit_truncate; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER audit_truncate BEFORE TRUNCATE ON public.audit FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_audit_change();


--
-- Name: persons person_delete; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER person_delete BEFORE DELETE ON public.persons FOR EACH ROW EXECUTE FUNCTION public.write_person_words();


--
-- Name: persons person_insert; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER person_insert AFTER INSERT ON public.persons FOR EACH ROW EXECUTE FUNCTION public.write_person_words();


--
-- Name: persons person_update; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER person_update AFTER UPDATE OF search_text ON public.persons FOR EACH ROW WHEN ((old.search_text <> new.search_text)) EXECUTE FUNCTION public.write_person_words();


--
-- Name: prescription_versions version_delete; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER version_delete BEFORE DELETE ON public.prescription_versions FOR EACH ROW EXECUTE FUNCTION public.check_version_delete();


--
-- Name: prescription_versions version_update; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER version_update BEFORE UPDATE ON public.prescription_versions FOR EACH ROW EXECUTE FUNCTION public.check_version_update();


--
-- Name: captures fk_captures_content_sha256; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.captures
    ADD CONSTRAINT fk_captures_content_sha256 FOREIGN KEY (content_sha256) REFERENCES public.contents(sha256);


--
-- Name: captures fk_captures_visit_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.captures
    ADD CONSTRAINT fk_captures_visit_id FOREIGN KEY (visit_id) REFERENCES public.visits(id);


--
-- Name: follow_ups fk_follow_ups_order_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.follow_ups
    ADD CONSTRAINT fk_follow_ups_order_id FOREIGN KEY (order_id) REFERENCES public.orders(id);


--
-- Name: follow_ups fk_follow_ups_person_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.follow_ups
    ADD CONSTRAINT fk_follow_ups_person_id FOREIGN KEY (person_id) REFERENCES public.persons(id);


--
-- Name: follow_ups fk_follow_ups_visit_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.follow_ups
    ADD CONSTRAINT fk_follow_ups_visit_id FOREIGN KEY (visit_id) REFERENCES public.visits(id);


--
-- Name: merges fk_merges_kept_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.merges
    ADD CONSTRAINT fk_merges_kept_id FOREIGN KEY (kept_id) REFERENCES public.persons(id);


--
-- Name: merges fk_merges_merged_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.merges
    ADD CONSTRAINT fk_merges_merged_id FOREIGN KEY (merged_id) REFERENCES public.persons(id);


--
-- Name: order_events fk_order_events_order_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_events
    ADD CONSTRAINT fk_order_events_order_id FOREIGN KEY (order_id) REFERENCES public.orders(id);


--
-- Name: order_feet fk_order_feet_order_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_feet
    ADD CONSTRAINT fk_order_feet_order_id FOREIGN KEY (order_id) REFERENCES public.orders(id);


--
-- Name: order_feet fk_order_feet_prescription_version_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_feet
    ADD CONSTRAINT fk_order_feet_prescription_version_id FOREIGN KEY (prescription_version_id) REFERENCES public.prescription_versions(id);


--
-- Name: order_files fk_order_files_content_sha256; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_files
    ADD CONSTRAINT fk_order_files_content_sha256 FOREIGN KEY (content_sha256) REFERENCES public.contents(sha256);


--
-- Name: order_files fk_order_files_order_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.order_files
    ADD CONSTRAINT fk_order_files_order_id FOREIGN KEY (order_id) REFERENCES public.orders(id);


--
-- Name: orders fk_orders_person_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.orders
    ADD CONSTRAINT fk_orders_person_id FOREIGN KEY (person_id) REFERENCES public.persons(id);


--
-- Name: orders fk_orders_visit_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.orders
    ADD CONSTRAINT fk_orders_visit_id FOREIGN KEY (visit_id) REFERENCES public.visits(id);


--
-- Name: person_words fk_person_words_person_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.person_words
    ADD CONSTRAINT fk_person_words_person_id FOREIGN KEY (person_id) REFERENCES public.persons(id);


--
-- Name: persons fk_persons_merged_into; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.persons
    ADD CONSTRAINT fk_persons_merged_into FOREIGN KEY (merged_into) REFERENCES public.persons(id);


--
-- Name: prescription_versions fk_prescription_versions_capture_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.prescription_versions
    ADD CONSTRAINT fk_prescription_versions_capture_id FOREIGN KEY (capture_id) REFERENCES public.captures(id);


--
-- Name: prescription_versions fk_prescription_versions_mesh_sha256; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.prescription_versions
    ADD CONSTRAINT fk_prescription_versions_mesh_sha256 FOREIGN KEY (mesh_sha256) REFERENCES public.contents(sha256);


--
-- Name: prescription_versions fk_prescription_versions_visit_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.prescription_versions
    ADD CONSTRAINT fk_prescription_versions_visit_id FOREIGN KEY (visit_id) REFERENCES public.visits(id);


--
-- Name: presence fk_presence_visit_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.presence
    ADD CONSTRAINT fk_presence_visit_id FOREIGN KEY (visit_id) REFERENCES public.visits(id);


--
-- Name: visit_photos fk_visit_photos_content_sha256; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.visit_photos
    ADD CONSTRAINT fk_visit_photos_content_sha256 FOREIGN KEY (content_sha256) REFERENCES public.contents(sha256);


--
-- Name: visit_photos fk_visit_photos_visit_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.visit_photos
    ADD CONSTRAINT fk_visit_photos_visit_id FOREIGN KEY (visit_id) REFERENCES public.visits(id);


--
-- Name: visits fk_visits_person_id; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.visits
    ADD CONSTRAINT fk_visits_person_id FOREIGN KEY (person_id) REFERENCES public.persons(id);


--
-- PostgreSQL database dump complete
--

